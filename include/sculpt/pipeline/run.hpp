#pragma once
// The whole program: a deck in, a mesh on disk out. The only room that names every stage.
#include <string>
#include <vector>

#include "sculpt/deck/deck.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

// Collective. Runs a validated deck; prints what real Sculpt prints. Returns the exit status, 0 or
// kPoorMeshStatus (launch.hpp), the same on all ranks. Throws AgreedError or Error on all ranks alike.
int run(const Comm& comm, const Deck& deck);

// The program: reads the command line and the deck (rank 0 reads, all agree), starts ranks if needed, runs.
// Returns the exit status.
int sculpt_main(int argc, char** argv);

}  // namespace sculpt

// The mesher: `sculpt -i deck.i -j N`; as `psculpt` one rank of it under mpiexec.
#include "sculpt/pipeline/run.hpp"

int main(int argc, char** argv) { return sculpt::sculpt_main(argc, argv); }

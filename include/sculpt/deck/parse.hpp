#pragma once
// Text to Deck. Everything here is a pure function of its arguments, so ranks that see the same words and the
// same deck text get the same Deck or the same Error.
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "sculpt/deck/deck.hpp"

namespace sculpt {

enum class Action { kRun, kHelp, kVersion, kPrintInput };

struct CommandLine {
  Deck deck;
  Action action = Action::kRun;
  std::string help_topic;  // for kHelp: empty, "all", an option, a group selector or "markdown"
};

// Gives the whole text of the named deck file, or throws Error. Called at most once per command line; ranks
// may make it collective (one reads, all receive).
using ReadText = std::function<std::string(const std::string& file_name)>;

// The deck named by -i first, then the words of the command line, which win. `words` excludes the program's
// name; no words at all ask for help. Errors: unknown words, missing or wrong values, everything parse_deck
// refuses.
[[nodiscard]] CommandLine parse_command_line(std::span<const std::string> words, const ReadText& read_text);

// The options between BEGIN SCULPT and END SCULPT. `file_name` is used in messages only.
[[nodiscard]] Deck parse_deck(std::string_view text, std::string_view file_name);

// The text of a file on this machine, for use as ReadText. Error: it cannot be read.
[[nodiscard]] std::string read_deck_file(const std::string& file_name);

// Fills in the defaults that depend on the input: exodus_file (named after the deck, else after the data
// file) and smooth, csmooth, laplacian_iters (3, 2, 10 with input_spn). What the user gave stays; what is set
// here is listed in deck.redefaulted.
void apply_input_defaults(Deck& deck);
// Those of smooth, csmooth and laplacian_iters that belong to input_spn.
void apply_voxel_defaults(Deck& deck);

// Refuses options that are not supported yet and options that contradict each other. num_procs must be final:
// under an MPI launcher set it to the number of ranks first. Error: one sentence naming the options and their
// places.
void validate(const Deck& deck);

}  // namespace sculpt

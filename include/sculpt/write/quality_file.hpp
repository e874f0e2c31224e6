#pragma once
// The file that the option `quality` asks for (layout: docs/file-formats.md).
#include <string>

#include "sculpt/deck/deck.hpp"
#include "sculpt/par/comm.hpp"
#include "sculpt/quality/fidelity.hpp"

namespace sculpt {

// Name of the file; empty when none is wanted. Decks of older versions say `true` instead of a name: then the
// file is called after the mesh.
[[nodiscard]] std::string quality_file_name(const Deck& deck);

// The content, for a mesh with this base name. Numbers are written so that they read back exactly.
[[nodiscard]] std::string quality_csv(const QualityReport& report, const std::string& mesh);
[[nodiscard]] std::string quality_json(const QualityReport& report, const std::string& mesh);

// Collective; rank 0 writes. JSON when the name ends in .json, else CSV. An earlier file is replaced when the
// new one is complete. Throws AgreedError.
void write_quality_file(const Comm& comm, const QualityReport& report, const std::string& mesh,
                        const std::string& file_name);

}  // namespace sculpt

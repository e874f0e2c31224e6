#pragma once
// The smooth surfaces of a faceted boundary, as CAD programs draw them: facets across whose common edges the
// normal hardly turns.
#include "sculpt/facets/facet_mesh.hpp"

namespace sculpt {

// Local. Fills FacetMesh::surface and corner of a repaired mesh. Two facets are on one surface when a chain
// of facets of one solid of the file leads from one to the other, each sharing an edge of just two facets
// with the next and having a normal that differs by at most `angle` degrees. Surfaces are numbered in the
// order of their first facets. At a corner three surfaces meet, or more; corners are numbered in the order of
// the vertices.
void divide_facets(FacetMesh& mesh, double angle);

}  // namespace sculpt

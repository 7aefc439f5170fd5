// Computes exact distances from lattice nodes to the triangles of a NarrowBand's skin.
//
// The potential is no exact distance and provides only the sign. A node's search begins at the
// nearest triangles of its neighbours nearer to the surface. The search moves to nearer triangles
// around the foot point until there are none. Each layer of nodes depends only on the previous
// layer, so the result does not depend on the number of threads.

#ifndef SkinBand_h
#define SkinBand_h

#include "Grids/LatticeMesh.h"

namespace activesurface
{

class NarrowBand;

// Returns the skin on the band's lattice, in the same coordinates.
LatticeMesh MakeSkinMesh(const NarrowBand& band);

// The mesh has to be that of MakeSkinMesh.
MeshBand MakeSkinBand(const NarrowBand& band, const LatticeMesh& mesh);

}

#endif

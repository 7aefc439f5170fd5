// A NarrowBand's surface as true distances to the triangles of its skin.
//
// The potential keeps a slope of its own; here it gives the sign only. The nearest triangle of a
// node is looked for from those of its neighbours that are nearer to the surface, by going on to
// nearer triangles beside the foot of the perpendicular until there is none. Each layer of nodes
// needs the one before alone, so the result does not depend on the number of threads.

#ifndef SkinBand_h
#define SkinBand_h

#include "Grids/LatticeMesh.h"

namespace activesurface
{

class NarrowBand;

// On the lattice of the band, whose nodes have the same coordinates.
LatticeMesh MakeSkinMesh(const NarrowBand& band);

// The mesh is that of MakeSkinMesh.
MeshBand MakeSkinBand(const NarrowBand& band, const LatticeMesh& mesh);

}

#endif

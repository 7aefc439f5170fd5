/**
 * The two metamorphoses, as input for both sides of the comparison. Lengths in voxels.
 */
#ifndef MorphScenes_h
#define MorphScenes_h

#include "NarrowBand.h"

#include <openvdb/openvdb.h>

#include <memory>
#include <string>

namespace activesurface
{

struct MorphScene
{
  std::string Name;
  double Bounds[6]; //< bounds of the start
  /** The start: as our function, and as a level set of half width 3. */
  InitialFunction Initial;
  openvdb::FloatGrid::Ptr Source;
  /** The target: as our target, and as distances on all nodes that the surface's band can meet. */
  std::shared_ptr<Target> Goal;
  openvdb::FloatGrid::Ptr GoalGrid;
};

/** A ball becomes a torus around it. Both sides evaluate the exact distance, ours from the formula
 * at the sample points, OpenVDB from its grid. */
MorphScene MakeBallToTorus(double radius);

/** A head with two long ears becomes a body with many bumps. Both are closed meshes, spheres whose
 * radius varies with the direction. Both sides read the same distances to the mesh, from OpenVDB's
 * meshToVolume. */
MorphScene MakeMeshToMesh(double radius);

}

#endif

/**
 * The two morphs, as both sides of the comparison get them. Lengths in voxels.
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
  double Bounds[6]; //< of the start
  /** The start: for us, and as a level set of half width 3. */
  InitialFunction Initial;
  openvdb::FloatGrid::Ptr Source;
  /** The target: for us, and as distances on all nodes that the surface's band can meet. */
  std::shared_ptr<Target> Goal;
  openvdb::FloatGrid::Ptr GoalGrid;
};

/** A ball becomes a torus around it; both sides evaluate the exact distance, we at the sample
 * points by the formula, OpenVDB from its grid. */
MorphScene MakeBallToTorus(double radius);

/** A head with two long ears becomes a body with many bumps: closed meshes, each a sphere whose
 * radius varies with the direction. Both sides read the same distances to the mesh, from
 * OpenVDB's meshToVolume. */
MorphScene MakeMeshToMesh(double radius);

}

#endif

/**
 * The two metamorphoses, as input for us and for OpenVDB. Lengths in voxels.
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
  /** The start: as our function, and as OpenVDB's level set of half width 3. */
  InitialFunction Initial;
  openvdb::FloatGrid::Ptr Source;
  /** The target: as ours, and as distances on all nodes that OpenVDB's band can meet. */
  std::shared_ptr<Target> Goal;
  openvdb::FloatGrid::Ptr GoalGrid;
};

/** A ball becomes a torus. We evaluate the exact distance at the sample points by its formula,
 * OpenVDB reads the distance from GoalGrid. */
MorphScene MakeBallToTorus(double radius);

/** A head with two long ears becomes a body with many bumps. Both bodies are closed meshes, spheres
 * whose radius varies with the direction. We and OpenVDB read the distance to the mesh from the
 * same grid, made by OpenVDB's meshToVolume. */
MorphScene MakeMeshToMesh(double radius);

}

#endif

/**
 * How far a point is from the surface, and on which side: a snapshot of a NarrowBand.
 *
 * With x in voxels, U(x) the trilinear interpolation of the potential u and S(x) that of its slope
 * |grad u| at the nodes (central differences; one-sided where a neighbour is beyond the layers),
 * the value is
 *
 *   VoxelSize * U(x) / S(x), clamped to +-3 voxels, negative inside.
 *
 * A distance to first order: exact at the surface, good within about 1.5 voxels. Nodes beyond all
 * layers count as u = +-3 with slope 1, and no slope as less than 0.05. The sign is U's, so the
 * surface passes through the vertices of the Skin.
 *
 * Evaluation takes a time that does not depend on the size of the surface, allocates nothing, and
 * may be done by several threads at once. Memory: two numbers for each node of the band's leaves.
 */
#ifndef SkinDistance_h
#define SkinDistance_h

#include "vtkActiveNarrowBandModule.h"

#include <memory>

namespace activesurface
{

class NarrowBand;

class VTKACTIVENARROWBAND_EXPORT SkinDistance
{
public:
  /** Copies what is needed: the band may change or go afterwards. */
  explicit SkinDistance(const NarrowBand& band);
  ~SkinDistance();

  /**
   * The value at a point [world units], and unless gradient is null the exact derivatives of the
   * formula, 0 where it is clamped. Without a surface: 3 voxels everywhere. Both are NaN where the
   * point is not finite.
   */
  double Evaluate(const double x[3], double* gradient) const;

  /** Box of the voxels that the surface crosses [world units]; false, and untouched, if none. */
  bool GetBounds(double bounds[6]) const;

private:
  SkinDistance(const SkinDistance&) = delete;
  void operator=(const SkinDistance&) = delete;

  struct State;
  std::unique_ptr<State> Members;
};

}

#endif

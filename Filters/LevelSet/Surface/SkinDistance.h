/**
 * Signed distance of a point from the surface, from a copy of the potential of a NarrowBand.
 *
 * U(x) and G(x) are the trilinear interpolations of the potential u and of the gradient norm |grad
 * u| at the nodes. The gradient is by central differences, one-sided where a neighbour is beyond
 * the layers. The value at x is
 *
 *   VoxelSize * U(x) / G(x), clamped to +-HalfWidth voxels, negative inside.
 *
 * The value is a first-order distance: exact at the surface, and accurate up to about 1.5 voxels
 * from the surface. Beyond all layers u is +-HalfWidth and the gradient norm is 1. Gradient norms
 * below 0.05 count as 0.05. The sign is that of U, so the zero set passes through the vertices of
 * the Skin, except vertices that Skin.h keeps away from a node.
 *
 * Evaluation needs constant time, allocates nothing and is thread-safe. Memory: two numbers for
 * each node of the band's leaves.
 */
#ifndef SkinDistance_h
#define SkinDistance_h

#include "ActiveLevelSetExport.h"

#include <memory>

namespace activesurface
{

class NarrowBand;

/** Limit of distances on either side of the surface [voxels]. */
constexpr float HalfWidth = 3.f;

class ACTIVELEVELSET_EXPORT SkinDistance
{
public:
  /** Copies the potential: the band may change or be deleted afterwards. */
  explicit SkinDistance(const NarrowBand& band);
  ~SkinDistance();

  /**
   * Returns the signed distance at a point [world units]. Writes the exact derivatives of the
   * formula unless gradient is null; derivatives are 0 where the distance is clamped. Without a
   * surface the distance is HalfWidth voxels everywhere. Distance and derivatives are NaN if the
   * point is not finite.
   */
  double Evaluate(const double x[3], double* gradient) const;

  /** Box of the voxels that the surface crosses [world units]. Returns false, and does not write
   * bounds, if there is no surface. */
  bool GetBounds(double bounds[6]) const;

private:
  SkinDistance(const SkinDistance&) = delete;
  void operator=(const SkinDistance&) = delete;

  struct State;
  void Read(const NarrowBand& band);

  std::unique_ptr<State> Members;
};

/**
 * Writes the signed distance to the surface [world units], negative inside, at the lattice nodes
 * extent[0]..extent[1], extent[2]..extent[3], extent[4]..extent[5], x fastest. The distance is the
 * potential divided by its gradient norm. This first-order distance is exact at the surface, and
 * accurate up to about 1.5 voxels from the surface. The distance is clamped to +-HalfWidth voxels,
 * the value beyond the band.
 */
ACTIVELEVELSET_EXPORT void WriteDistances(
  const NarrowBand& band, const int extent[6], float* distances);

}

#endif

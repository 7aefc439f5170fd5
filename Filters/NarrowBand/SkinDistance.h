/**
 * How far a point is from the surface, and on which side: a snapshot of a NarrowBand.
 *
 * With x in voxels, U(x) the trilinear interpolation of the potential u, and G(x) that of its
 * gradient norm |grad u| at the nodes (central differences; one-sided where a neighbour is beyond
 * the layers), the value is
 *
 *   VoxelSize * U(x) / G(x), clamped to +-HalfWidth voxels, negative inside.
 *
 * A distance to first order: exact at the surface, good within about 1.5 voxels. Nodes beyond all
 * layers count as u = +-HalfWidth with gradient norm 1; norms below 0.05 count as 0.05. The sign is
 * that of U, so the surface passes through the vertices of the Skin.
 *
 * Evaluation takes constant time, allocates nothing and is thread-safe. Memory: two numbers for
 * each node of the band's leaves.
 */
#ifndef SkinDistance_h
#define SkinDistance_h

#include "ActiveNarrowBandExport.h"

#include <memory>

namespace activesurface
{

class NarrowBand;

/** How far distances reach on either side of the surface [voxels]; beyond, they are clamped. */
constexpr float HalfWidth = 3.f;

class ACTIVENARROWBAND_EXPORT SkinDistance
{
public:
  /** Copies what it needs: the band may change or be deleted afterwards. */
  explicit SkinDistance(const NarrowBand& band);
  ~SkinDistance();

  /**
   * The value at a point [world units], and unless gradient is null the exact derivatives of the
   * formula, 0 where it is clamped. HalfWidth voxels everywhere if there is no surface. Both are
   * NaN if the point is not finite.
   */
  double Evaluate(const double x[3], double* gradient) const;

  /** Box of the voxels that the surface crosses [world units]; false, and untouched, if none. */
  bool GetBounds(double bounds[6]) const;

private:
  SkinDistance(const SkinDistance&) = delete;
  void operator=(const SkinDistance&) = delete;

  struct State;
  void Read(const NarrowBand& band);

  std::unique_ptr<State> Members;
};

}

#endif

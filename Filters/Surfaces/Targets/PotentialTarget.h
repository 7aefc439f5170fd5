// A potential F as the target of a surface: which of its level sets, which side of it, and whether
// F itself or the distance that it tells is what attracts.

#ifndef PotentialTarget_h
#define PotentialTarget_h

#include "InitialFunction.h"
#include "Target.h"

#include <limits>

namespace activesurface
{

struct TargetOptions
{
  double IsoValue = 0.0;
  bool Invert = false;

  // (F - iso) / |grad F|, the first-order distance, clamped to +-Reach, instead of F - iso. Where
  // the gradient vanishes or is not finite there is no distance: +-Reach by the sign of F - iso.
  bool Normalize = true;
  double Reach = std::numeric_limits<double>::infinity();

  // Where the surface is off by less than this, that may be noise, and attracts by a small share
  // [length]. 0: none. With Normalize only.
  double Noise = 0.0;
};

class PotentialTarget : public Target
{
public:
  explicit PotentialTarget(const TargetOptions& options);

  void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const override;

  // F - iso, negative inside, never normalized: for its zero set alone.
  void EvaluateLevel(std::size_t count, const double* points, double* values) const;

  // The same, and |grad F|, 1 where it is 0 or not finite.
  void EvaluateLevel(std::size_t count, const double* points, double* values, double* slopes) const;

  // Whether its regions together hold its zero set.
  virtual bool IsWithinRegions() const { return false; }

  // Places near its zero set, for the start; none where they are not known.
  virtual SurfacePoints FindSurface() const { return {}; }

protected:
  const TargetOptions& GetOptions() const { return this->Options; }

  // F at points (x y z each), and its gradient unless gradients is null.
  virtual void Sample(
    std::size_t count, const double* points, double* values, double* gradients) const = 0;

private:
  double Side(double value) const;
  void FollowNoiseSlowly(double& value, double& slope) const;
  void TurnIntoDistance(double length, double& value, double& slope) const;

  TargetOptions Options;
};

}

#endif

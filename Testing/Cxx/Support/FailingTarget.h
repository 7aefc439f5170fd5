/**
 * A target that fails on request of a test.
 */
#ifndef FailingTarget_h
#define FailingTarget_h

#include "Support/RegionTargets.h"

#include <functional>
#include <stdexcept>

namespace activesurface
{

/** Calls of a target so far. */
struct AskedTarget
{
  double Time = 0.0;
  int Moves = 0;       //< calls of MoveTo
  int Evaluations = 0; //< calls of Evaluate
};

/** Fails in an evaluation if the rule returns true. */
class FailingTarget : public RegionTarget
{
public:
  using Rule = std::function<bool(const AskedTarget&)>;

  FailingTarget(const RegionTarget& target, const Rule& fails)
    : RegionTarget(target)
    , Fails(fails)
  {
  }

  FailingTarget(const Shape& shape, const Rule& fails)
    : FailingTarget(MakeStanding(shape, {}), fails)
  {
  }

  bool IsThreadSafe() const override { return false; }

  int CountEvaluations() const { return this->Asked.Evaluations; }

  void MoveTo(double time) override
  {
    RegionTarget::MoveTo(time);
    this->Asked.Time = time;
    ++this->Asked.Moves;
  }

  void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const override
  {
    ++this->Asked.Evaluations;
    if (this->Fails && this->Fails(this->Asked))
    {
      throw std::runtime_error("no such target.");
    }
    RegionTarget::Evaluate(count, points, results);
  }

private:
  Rule Fails; //< empty: never
  mutable AskedTarget Asked;
};

}

#endif

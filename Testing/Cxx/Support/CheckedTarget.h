/**
 * A target that notices where it is asked on ranks.
 */
#ifndef CheckedTarget_h
#define CheckedTarget_h

#include "Target.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace activesurface
{

/** Another target, which counts the points at which a rank asks though they are not near its own
 * places. */
class CheckedTarget : public Target
{
public:
  explicit CheckedTarget(std::unique_ptr<Target> target)
    : Asked(std::move(target))
  {
  }

  std::size_t CountAstray() const { return this->Astray; }
  std::size_t CountNear() const { return this->Near; }

  void KeepNear(const OwnPlaces* places) noexcept override { this->Places = places; }
  void MoveTo(double time) override { this->Asked->MoveTo(time); }
  bool MayHaveChanged(const double bounds[6]) const override
  {
    return this->Asked->MayHaveChanged(bounds);
  }
  void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const override
  {
    this->Check(count, points);
    this->Asked->Evaluate(count, points, results);
  }
  bool HasRegions() const override { return this->Asked->HasRegions(); }
  std::size_t CountRegionSources() const override { return this->Asked->CountRegionSources(); }
  void VisitRegions(std::size_t first, std::size_t end, const RegionVisitor& visit) const override
  {
    this->Asked->VisitRegions(first, end, visit);
  }
  void ForEachPart(const PartVisitor& visit) const override { this->Asked->ForEachPart(visit); }
  bool IsThreadSafe() const override { return this->Asked->IsThreadSafe(); }

private:
  void Check(std::size_t count, const double* points) const
  {
    for (const double* x = points; this->Places && x < points + 3 * count; x += 3)
    {
      const double bounds[] = { x[0], x[0], x[1], x[1], x[2], x[2] };
      std::vector<int> ranks;
      this->Places->FindRanks(bounds, ranks);
      const bool isNear =
        std::find(ranks.begin(), ranks.end(), this->Places->GetRank()) != ranks.end();
      ++(isNear ? this->Near : this->Astray);
    }
  }

  std::unique_ptr<Target> Asked;
  const OwnPlaces* Places = nullptr;
  mutable std::atomic<std::size_t> Near{ 0 };
  mutable std::atomic<std::size_t> Astray{ 0 };
};

}

#endif

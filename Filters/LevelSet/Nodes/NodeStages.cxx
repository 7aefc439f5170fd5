#include "Nodes/NodeStages.h"

#include "Base/PortableMath.h"
#include "Base/Tension.h"
#include "Nodes/LeafPoints.h"
#include "Nodes/StagePlan.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace activesurface
{

namespace
{

/**
 * Factor of the attraction within the noise of a body. With this factor and Attraction dt = 6,
 * distances fall by a sixth per frame.
 */
constexpr float SlowShare = .03f;
/**
 * A body counts as full from the bulk FullTo on, and as partly full from FullFrom on. The noise of
 * a full body is multiplied by NoiseOfFull.
 */
constexpr float FullFrom = .5f, FullTo = .75f, NoiseOfFull = 1.5f;
/** Where, in a body, tension balances attraction up to Imbalance times the noise, a further factor
 * reduces both terms. The attraction then has the fraction SlowestShare of its full value. */
constexpr float Imbalance = .25f, SlowestShare = .008f;
/** Weight g of tension (NodeStages.h): the bulk times a factor that is TensionOfHalf up to the bulk
 * FullFrom, and 1 from FullTo on. */
constexpr float TensionOfHalf = 1.f / 3.f;

/** |grad G| of a row by central differences [1/voxel]. c: the row of the target's potential G in a
 * block. */
ACTIVE_ALWAYS_INLINE Lanes SlopeOf(const float* c)
{
  constexpr int X = NodeBlock<1>::X, Y = NodeBlock<1>::Y;
  const Lanes gx = LoadLanes(c + X) - LoadLanes(c - X);
  const Lanes gy = LoadLanes(c + Y) - LoadLanes(c - Y);
  const Lanes gz = LoadLanes(c + 1) - LoadLanes(c - 1);
  return AllLanes(.5f) * Root(gx * gx + gy * gy + gz * gz);
}

/** Sets the distances Psi, and the slack if Slack is not null; see FindDistances. */
struct DistanceKernel
{
  const NodeLeaves& Leaves;
  const NodeArrays& Potential;
  const NodeFreedom& Freedom;
  NodeArrays& Psi;
  NodeArrays* Slack;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    const NodeLeaf& leaf = this->Leaves[i];
    NodeBlock<1> block;
    block.Gather(this->Potential, leaf, 1.f);
    for (int row = 0; row < 64; ++row)
    {
      const float* c = block.Row(row >> 3, row & 7);
      const Lanes value = LoadLanes(c);
      const Lanes slope =
        AllLanes(this->Freedom.Unit) * Largest(SlopeOf(c), AllLanes(this->Freedom.LeastSlope));
      const LaneMask isNear = Size(value) < slope * AllLanes(NodeLimit);
      const Lanes side = value < AllLanes(0.f) ? AllLanes(-NodeLimit) : AllLanes(NodeLimit);
      StoreLanes(
        this->Psi.Of(i) + 8 * row, Pick(isNear, value / Pick(isNear, slope, AllLanes(1.f)), side));
      if (this->Slack)
      {
        StoreLanes(this->Slack->Of(i) + 8 * row, AllLanes(this->Freedom.HalfWidth) / slope);
      }
    }
  }
};

/** A stage. W: number of nodes that the widest differences read on either side. */
template <int W>
struct StageKernel
{
  const NodeFields& Fields;
  const StageCoefficients& Coefficients;
  float Share; // duration of the stage
  float Fine;  // see StagePlan
  float Shift; // added to the potential near the surface, within the slack

  /** In the second loop, each row needs a chain of divisions. The processor overlaps the chains of
   * several rows, because the first loop has found the tension and iterations are short. */
  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    if (this->Fields.IsFar[i])
    {
      return;
    }
    const NodeLeaf& leaf = this->Fields.Leaves[i];
    const float *psi = this->Fields.Psi.Of(i), *before = this->Fields.Potential.Of(i);
    alignas(32) float pulls[512], bulks[512];
    std::uint64_t moving = leaf.Rows;
    NodeBlock<W> block;
    block.Gather(this->Fields.Potential, leaf, NodeLimit);
    for (std::uint64_t rows = leaf.Rows; rows != 0; rows &= rows - 1)
    {
      const int row = LowestBit(rows);
      if (BitsOf(AreFar(LoadLanes(before + 8 * row), LoadLanes(psi + 8 * row))) == 0xffu)
      {
        moving &= ~(std::uint64_t(1) << row);
        continue;
      }
      const Lanes bulk = ExpandRow(this->Fields.Bulk[i].data(), row >> 3, row & 7);
      StoreLanes(bulks + 8 * row, bulk);
      StoreLanes(pulls + 8 * row, this->FindPull(block.Row(row >> 3, row & 7), bulk));
    }
    float* next = this->Fields.Room.Of(i);
    std::memcpy(next, psi, 512 * sizeof(float));
    for (std::uint64_t rows = moving; rows != 0; rows &= rows - 1)
    {
      const int at = 8 * LowestBit(rows);
      const Lanes target = LoadLanes(psi + at);
      Lanes moved =
        this->Advance(LoadLanes(before + at), target, LoadLanes(bulks + at), LoadLanes(pulls + at));
      if (this->Fields.Slack)
      {
        const Lanes slack = LoadLanes(this->Fields.Slack->Of(i) + at);
        moved = Least(Largest(moved + AllLanes(this->Shift), target - slack), target + slack);
        moved = Pick(AreFar(LoadLanes(before + at), target), target, moved);
      }
      StoreLanes(next + at, Clamp(moved, NodeLimit));
    }
  }

private:
  static ACTIVE_ALWAYS_INLINE LaneMask AreFar(const Lanes& u, const Lanes& psi)
  {
    constexpr float far = .999f * NodeLimit;
    return (u * psi > AllLanes(0.f)) & (Size(u) >= AllLanes(far)) & (Size(psi) >= AllLanes(far));
  }

  /** Returns b g kappa |grad u|; see NodeStages.h. */
  ACTIVE_ALWAYS_INLINE Lanes FindPull(const float* c, const Lanes& bulk) const
  {
    if (!(this->Coefficients.Tension > 0.f))
    {
      return AllLanes(0.f);
    }
    const Lanes wanted = this->FindTension(bulk);
    const Lanes fine = Least(wanted, AllLanes(this->Fine));
    Lanes pull = fine * Bend<NodeBlock<W>::X, NodeBlock<W>::Y, 1>(c);
    if constexpr (W == 2)
    {
      const Lanes rest = wanted - fine;
      if (BitsOf(rest > AllLanes(0.f)) != 0)
      {
        pull += rest * Bend<NodeBlock<W>::X, NodeBlock<W>::Y, 2>(c);
      }
    }
    return pull;
  }

  ACTIVE_ALWAYS_INLINE Lanes FindTension(const Lanes& bulk) const
  {
    const Lanes tension = AllLanes(this->Coefficients.Tension),
                full = SmoothStep(FullFrom, FullTo, bulk);
    const Lanes weight = bulk * (AllLanes(TensionOfHalf) + AllLanes(1.f - TensionOfHalf) * full);
    return this->Coefficients.IsWeighted ? tension * weight : tension;
  }

  ACTIVE_ALWAYS_INLINE Lanes Advance(
    const Lanes& u, const Lanes& psi, const Lanes& bulk, const Lanes& pull) const
  {
    const Lanes one = AllLanes(1.f), miss = psi - u;
    Lanes rate = AllLanes(this->Coefficients.Decay), lambda = one;
    if (this->Coefficients.Noise > 0.f)
    {
      this->Slow(u, miss, pull, bulk, rate, lambda);
    }
    // Exponential Euler, exact at a steady state. e^x = 1 + x * series, to the fourth power of x.
    const Lanes x = AllLanes(this->Share) * rate * lambda;
    const Lanes series =
      one + x * (AllLanes(.5f) + x * (AllLanes(1.f / 6.f) + x * AllLanes(1.f / 24.f)));
    const Lanes decayed = one / (one + x * series);
    const Lanes mean = series * decayed; // (1 - decayed) / x
    return psi - decayed * miss + AllLanes(this->Share) * pull * lambda * mean;
  }

  /** Reduces the attraction within the noise of a body. Where attraction and tension nearly
   * balance, reduces both terms by the same factor, so that fixed points do not move. */
  ACTIVE_ALWAYS_INLINE void Slow(const Lanes& u, const Lanes& miss, const Lanes& pull,
    const Lanes& bulk, Lanes& rate, Lanes& lambda) const
  {
    const Lanes one = AllLanes(1.f), full = SmoothStep(FullFrom, FullTo, bulk);
    const Lanes body = Least(bulk + bulk, one);
    // The noise grows with |u|: away from the skin the slope of u is not 1, and frames differ more.
    const Lanes noise = (one + AllLanes(NoiseOfFull - 1.f) * full) *
      AllLanes(this->Coefficients.Noise) * (one + Size(u));
    const Lanes slow = one - body * AllLanes(1.f - SlowShare);
    rate *= slow + (one - slow) * Step(miss, noise);
    const Lanes slowest = Least(AllLanes(this->Coefficients.Decay * SlowestShare) / rate, one);
    const Lanes off = Step(miss * rate + pull, rate * AllLanes(Imbalance) * noise);
    lambda = slowest + (one - slowest) * ((one - body) + body * off);
    lambda = Pick(body > AllLanes(0.f), lambda, one);
  }

  /** Returns q^4 / (1 + q^4) for q = a / b. */
  static ACTIVE_ALWAYS_INLINE Lanes Step(const Lanes& a, const Lanes& b)
  {
    constexpr float least = 1e-30f; // avoids underflow of b^4
    const Lanes a2 = a * a, b2 = b * b, a4 = a2 * a2;
    return a4 / (a4 + Largest(b2 * b2, AllLanes(least)));
  }
};

/** Area of the skin [voxels^2], and volume inside the skin in the leaves [voxels^3], estimated at
 * the nodes. A node within half a voxel of the skin counts partly for the volume, and as 1 for the
 * area. */
struct SkinEstimate
{
  double Volume = 0.0, Area = 0.0;
};

/** Keeps the volume of a skin with NodeFreedom from stage to stage. Otherwise tension would press
 * the skin against the inner limit of the freedom. The inner limit has the steps of the pixels, so
 * the skin would show the steps. */
class VolumeKeeper
{
public:
  explicit VolumeKeeper(const NodeFields& fields)
    : Fields(fields)
    , Parts(fields.Slack ? fields.Leaves.Size() : 0)
    , AtStart(this->Estimate().Volume)
  {
  }
  /** Returns the shift of the potential that restores the volume, to first order; 0 without
   * freedom. */
  float FindShift()
  {
    const SkinEstimate now = this->Estimate();
    const double distance = now.Area > 0.0 ? (now.Volume - this->AtStart) / now.Area : 0.0;
    return static_cast<float>(distance / static_cast<double>(this->Fields.Unit));
  }

private:
  /** Returns 0 without freedom. */
  SkinEstimate Estimate()
  {
    SkinEstimate sum;
    if (!this->Fields.Slack)
    {
      return sum;
    }
    this->Fields.Leaves.ForEach([this](std::size_t i) { this->Parts[i] = this->EstimateLeaf(i); });
    for (const SkinEstimate& part : this->Parts) // a fixed order, for bitwise identical sums
    {
      sum.Volume += part.Volume;
      sum.Area += part.Area;
    }
    return sum;
  }
  SkinEstimate EstimateLeaf(std::size_t i) const
  {
    const float* values = this->Fields.Potential.Of(i);
    SkinEstimate leaf;
    for (int node = 0; node < 512; ++node)
    {
      const float inside = .5f - this->Fields.Unit * values[node];
      leaf.Volume += static_cast<double>(std::min(std::max(inside, 0.f), 1.f));
      leaf.Area += inside > 0.f && inside < 1.f ? 1.0 : 0.0;
    }
    return leaf;
  }

  const NodeFields& Fields;
  std::vector<SkinEstimate> Parts; //< of each leaf
  const double AtStart;
};

template <int W>
void RunStage(const NodeFields& fields, const StageCoefficients& coefficients, float share,
  float fine, float shift)
{
  fields.Leaves.RunKernel(StageKernel<W>{ fields, coefficients, share, fine, shift });
  std::swap(fields.Potential, fields.Room);
}

}

float FindFollowedShare(const StageCoefficients& coefficients, float miss, float bulk)
{
  float share = 1.f;
  if (coefficients.Noise > 0.f)
  {
    const float t = std::min(std::max((bulk - FullFrom) / (FullTo - FullFrom), 0.f), 1.f);
    const float full = t * t * (3.f - 2.f * t);
    const float q = miss / ((1.f + (NoiseOfFull - 1.f) * full) * coefficients.Noise);
    const float power = (q * q) * (q * q);
    const float slow = 1.f - std::min(2.f * bulk, 1.f) * (1.f - SlowShare);
    share = slow + (1.f - slow) * power / (1.f + power);
  }
  return static_cast<float>(-ExponentialMinusOne(-share * coefficients.Decay));
}

void FindDistances(const NodeLeaves& leaves, const NodeArrays& potential,
  const NodeFreedom& freedom, NodeArrays& psi, NodeArrays& slack)
{
  const bool isFree = freedom.HalfWidth > 0.f;
  psi.MakeRoom(leaves.Size());
  slack.MakeRoom(isFree ? leaves.Size() : 0);
  leaves.RunKernel(DistanceKernel{ leaves, potential, freedom, psi, isFree ? &slack : nullptr });
}

void RunStages(const NodeFields& fields, const StageCoefficients& given)
{
  StageCoefficients coefficients = given;
  coefficients.Tension = std::min(given.Tension, MostStageTension);
  const StagePlan plan =
    fields.Slack ? PlanEqualStages(coefficients.Tension) : PlanCycles(coefficients.Tension);
  VolumeKeeper keeper(fields);
  for (int stage = 0; stage < plan.Count; ++stage)
  {
    const float share = plan.GetShare(stage);
    fields.Halo.Refresh(fields.Potential);
    const float shift = keeper.FindShift();
    coefficients.Tension <= plan.Fine ? RunStage<1>(fields, coefficients, share, plan.Fine, shift)
                                      : RunStage<2>(fields, coefficients, share, plan.Fine, shift);
  }
}

}

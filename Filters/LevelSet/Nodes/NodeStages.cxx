#include "Nodes/NodeStages.h"

#include "Base/Tension.h"
#include "Nodes/LeafPoints.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace activesurface
{

namespace
{

/** Least number of stages with attraction: five decays by e^(-1.2) at the automatic Attraction dt =
 * 6. In five stages, differences over 2 and 4 nodes compute the whole automatic tension if h is at
 * least half of the particle spacing. */
constexpr int FewestStages = 5;

/** Without attraction, up to this number of stages compute all tension by differences over 2 nodes.
 * Wider differences are less accurate on thin parts. */
constexpr int FineStages = 64;
/** Largest Tension dt / h^2 of a stage by differences over 2 nodes only: explicit diffusion is
 * stable up to 1/6. */
constexpr float TensionOfFineStage = .15f;

/** Largest Tension dt / h^2 of any other stage: by differences over 2 nodes, by differences over 4
 * nodes, and by all differences (over 2, 4 and 8 nodes). A stage multiplies a wave on a flat
 * surface by 1 - g; g is the sum of Tension dt / h^2 by the differences over 2, 4 and 8 nodes, each
 * times the factor of these differences for the wave. Over all normals and waves g is at most 1.66.
 * If g exceeded 2, waves of three nodes would grow from stage to stage. Differences over 8 nodes
 * compute a third of the tension at most: with half of it, waves of 8 nodes are damped so little
 * that they show. */
constexpr float TensionOfStage = .1f, SecondOfStage = .5f, TensionOfStages = .9f;

/**
 * Factor of the attraction within the noise of a body. With this factor and Attraction dt = 6,
 * distances fall by a sixth per frame.
 */
constexpr float SlowShare = .03f;
/**
 * A body is full from the bulk FullTo on; the transition begins at FullFrom. The noise of a full
 * body is multiplied by NoiseOfFull, because the particles of a body agree on the surface.
 */
constexpr float FullFrom = .5f, FullTo = .75f, NoiseOfFull = 1.5f;
/** If, in a body, attraction and tension are out of balance by less than Imbalance times the noise,
 * both rates are reduced to the fraction SlowestShare of the attraction. */
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
      const Lanes slope = Largest(SlopeOf(c), AllLanes(this->Freedom.LeastSlope));
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

/** Number of stages, and the largest Tension dt / h^2 of all stages together: First by differences
 * over 2 nodes, Second by differences over 4 nodes. */
struct StagePlan
{
  int Count;
  float First, Second;
};

StagePlan PlanStages(const StageCoefficients& coefficients)
{
  const float tension = coefficients.Tension;
  if (coefficients.Decay == 0.f && tension <= TensionOfFineStage * FineStages)
  {
    const int count = static_cast<int>(std::ceil(tension / TensionOfFineStage));
    return { std::max(1, count), tension, 0.f };
  }
  constexpr float most = 1e6f;
  const float wanted = std::min(std::ceil(tension / TensionOfStages), most);
  const int fewest = coefficients.Decay == 0.f ? FineStages : FewestStages;
  const int count = std::max(fewest, static_cast<int>(wanted));
  return { count, TensionOfStage * static_cast<float>(count),
    SecondOfStage * static_cast<float>(count) };
}

/** One of the plan's stages. W: number of nodes that the widest differences read on either side. */
template <int W>
struct StageKernel
{
  const NodeFields& Fields;
  const StageCoefficients& Coefficients;
  const StagePlan& Plan;
  float Shift; // added to the potential, within the slack

  /** The first loop finds the tension of all rows. The second loop is a chain of divisions. The
   * short iterations of the second loop let the processor overlap several rows. */
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
      if (StaysFar(LoadLanes(before + 8 * row), LoadLanes(psi + 8 * row)))
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
      }
      StoreLanes(next + at, Clamp(moved, NodeLimit));
    }
  }

private:
  static ACTIVE_ALWAYS_INLINE bool StaysFar(const Lanes& u, const Lanes& psi)
  {
    constexpr float far = .999f * NodeLimit;
    const LaneMask isFar =
      (u * psi > AllLanes(0.f)) & (Size(u) >= AllLanes(far)) & (Size(psi) >= AllLanes(far));
    return BitsOf(isFar) == 0xffu;
  }

  /** Returns b g kappa |grad u|; see NodeStages.h. Differences over 2 nodes compute the tension up
   * to their stable limit, wider differences compute the rest. */
  ACTIVE_ALWAYS_INLINE Lanes FindPull(const float* c, const Lanes& bulk) const
  {
    if (!(this->Coefficients.Tension > 0.f))
    {
      return AllLanes(0.f);
    }
    const Lanes wanted = this->FindTension(bulk);
    const Lanes first = Least(wanted, AllLanes(this->Plan.First));
    Lanes pull = first * Bend<NodeBlock<W>::X, NodeBlock<W>::Y, 1>(c);
    if constexpr (W >= 2)
    {
      const Lanes rest = wanted - first;
      const Lanes second = W == 2 ? rest : Least(rest, AllLanes(this->Plan.Second));
      if (BitsOf(second > AllLanes(0.f)) != 0)
      {
        pull += second * Bend<NodeBlock<W>::X, NodeBlock<W>::Y, 2>(c);
      }
      if constexpr (W >= 4)
      {
        const Lanes third = rest - second;
        if (BitsOf(third > AllLanes(0.f)) != 0)
        {
          pull += third * Bend<NodeBlock<W>::X, NodeBlock<W>::Y, 4>(c);
        }
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
    const float share = 1.f / static_cast<float>(this->Plan.Count);
    Lanes rate = AllLanes(this->Coefficients.Decay), lambda = one;
    if (this->Coefficients.Noise > 0.f)
    {
      this->Slow(u, miss, pull, bulk, rate, lambda);
    }
    // Exponential Euler, exact at a steady state. e^x = 1 + x * series, to the fourth power of x.
    const Lanes x = AllLanes(share) * rate * lambda;
    const Lanes series =
      one + x * (AllLanes(.5f) + x * (AllLanes(1.f / 6.f) + x * AllLanes(1.f / 24.f)));
    const Lanes decayed = one / (one + x * series);
    const Lanes mean = series * decayed; // (1 - decayed) / x
    return psi - decayed * miss + AllLanes(share) * pull * lambda * mean;
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
  /** Returns the shift of the potential [voxels] that restores the volume, to first order; 0
   * without freedom. */
  float FindShift()
  {
    const SkinEstimate now = this->Estimate();
    return now.Area > 0.0 ? static_cast<float>((now.Volume - this->AtStart) / now.Area) : 0.f;
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
      const float inside = .5f - values[node];
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
void RunStage(const NodeFields& fields, const StageCoefficients& coefficients,
  const StagePlan& plan, float shift)
{
  fields.Leaves.RunKernel(StageKernel<W>{ fields, coefficients, plan, shift });
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
  const float x = share * coefficients.Decay / static_cast<float>(FewestStages);
  const float decayed = 1.f / (1.f + x * (1.f + x * (.5f + x * (1.f / 6.f + x / 24.f))));
  return 1.f - (decayed * decayed) * (decayed * decayed);
}

void FindDistances(const NodeLeaves& leaves, const NodeArrays& potential,
  const NodeFreedom& freedom, NodeArrays& psi, NodeArrays& slack)
{
  const bool isFree = freedom.HalfWidth > 0.f;
  psi.MakeRoom(leaves.Size());
  slack.MakeRoom(isFree ? leaves.Size() : 0);
  leaves.RunKernel(DistanceKernel{ leaves, potential, freedom, psi, isFree ? &slack : nullptr });
}

void RunStages(const NodeFields& fields, const StageCoefficients& coefficients)
{
  constexpr float rounded = 1.f + 1e-3f;
  const StagePlan plan = PlanStages(coefficients);
  const float tension = coefficients.Tension, both = (plan.First + plan.Second) * rounded;
  VolumeKeeper keeper(fields);
  for (int stage = 0; stage < plan.Count; ++stage)
  {
    fields.Halo.Refresh(fields.Potential);
    const float shift = keeper.FindShift();
    tension <= plan.First ? RunStage<1>(fields, coefficients, plan, shift)
      : tension <= both   ? RunStage<2>(fields, coefficients, plan, shift)
                          : RunStage<4>(fields, coefficients, plan, shift);
  }
}

}

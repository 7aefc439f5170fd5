#include "Nodes/FitKernels.h"

#include "Base/InstructionSets.h"
#include "Nodes/LaneMatrix.h"
#include "Nodes/NodeSums.h"

#include <algorithm>

namespace activesurface
{

namespace
{

// Deep (GroupFits) grows from 0 to 1 between these distances to the neighbours' mean [radii of the
// neighbourhood]. In a cubic lattice: 0.2 in a deep body's surface layer, below 0.1 inside.
constexpr float LeastDepth = .1f;
constexpr float FullDepth = .22f;

// Distance of a body's surface from its outermost particles, minus 1 [own radii]. This excess
// compensates for the volume that the body's edges lose.
constexpr float OffsetOfBody = .1f;

// Bulk (GroupFits) grows from 0 to 1 between these densities of neighbours [particles per (2 own
// radii)^3]. Density: 0.28 in a one-layer sheet, 0.63 and 0.87 in a body's two outermost layers.
constexpr float LeastBody = .3f;
constexpr float FullBody = .8f;

// Support radius of a particle / its support radius in a body: grows from LeastReach to 1 between
// these densities of neighbours [particles per (2 own radii)^3].
constexpr float LeastReach = .7f;
constexpr float DensityOfLeastReach = .05f, DensityOfFullReach = .2f;

// Shape (GroupFits) grows from 0 to 1 between FewestNeighbours and EnoughNeighbours: sums of the
// weights of the particle (1) and of neighbours within NearPerWide neighbourhood radii.
// The sum is 2.1 with two neighbours, 4.2 in a one-layer sheet, about 6 at a body's surface.
constexpr float NearPerWide = .55f;
constexpr float FewestNeighbours = 2.2f;
constexpr float EnoughNeighbours = 4.2f;

// Displacement of an ellipsoid's centre / (Shape * distance to the mean of the neighbours).
constexpr float ShareOfMean = .9f;

// Thin (GroupFits) is the larger of two weights. One falls from 1 to 0 while shortest half-axis /
// max(middle, ThinRatio * longest) grows from ThinRatio to ThickRatio; the ratio is 0 in a sheet of
// one layer, about 1 in a body. The other falls while longest / neighbourhood's radius grows from
// TinySize to SmallSize; the ratio is 0 for coincident particles, 0.14 for a pair, 0.33 in a body.
constexpr float ThinRatio = .25f, ThickRatio = .6f;
constexpr float TinySize = .05f, SmallSize = .12f;

// Triangulation reduces the radius r of a ball by 0.155 / r [voxels]. Here r is at least LeastBall,
// because the lattice shows no smaller ball.
constexpr float LossOfTriangles = .155f;
constexpr float LeastBall = .5f;
constexpr float WholeBall = 32.f * 3.14159265f / 105.f; // integral of (1 - d^2)^2, unit ball

struct ListKernel
{
  const FitGroup& Group;
  const PlaceColumns& Columns;
  const ParticleRuns& Runs;
  FitNeighbour*& End;

  ACTIVE_ALWAYS_INLINE void operator()() const
  {
    FitNeighbour* to = this->End;
    for (const ParticleRun& run : this->Runs)
    {
      to = this->AddRun(run, to);
    }
    this->End = to;
  }

private:
  ACTIVE_ALWAYS_INLINE FitNeighbour* AddRun(const ParticleRun& run, FitNeighbour* to) const
  {
    const Lanes zero = AllLanes(0.f);
    const float *m = this->Group.Middle, *h = this->Group.Half;
    for (std::uint32_t k = run.First; k < run.End; k += 8)
    {
      const Lanes x = LoadLanes(this->Columns.X + k) + AllLanes(run.Shift[0]);
      const Lanes y = LoadLanes(this->Columns.Y + k) + AllLanes(run.Shift[1]);
      const Lanes z = LoadLanes(this->Columns.Z + k) + AllLanes(run.Shift[2]);
      const Lanes gx = Largest(Size(x - AllLanes(m[0])) - AllLanes(h[0]), zero);
      const Lanes gy = Largest(Size(y - AllLanes(m[1])) - AllLanes(h[1]), zero);
      const Lanes gz = Largest(Size(z - AllLanes(m[2])) - AllLanes(h[2]), zero);
      unsigned near = BitsOf(gx * gx + gy * gy + gz * gz < LoadLanes(this->Columns.Reach2 + k));
      near &= run.End - k >= 8 ? 0xffu : (1u << (run.End - k)) - 1u;
      for (; near != 0; near &= near - 1)
      {
        const int i = LowestBit(near);
        *to++ = { { x[i], y[i], z[i] }, k + static_cast<std::uint32_t>(i) };
      }
    }
    return to;
  }
};

}

double FindLossOfBall(double ownRadius)
{
  return LossOfTriangles / (std::max(ownRadius, static_cast<double>(LeastBall)) * ownRadius);
}

void FitGroup::FindBox()
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const float* place = this->Place[axis];
    const auto ends = std::minmax_element(place, place + this->Count);
    this->Middle[axis] = .5f * (*ends.first + *ends.second);
    this->Half[axis] = .5f * (*ends.second - *ends.first);
  }
}

void ListNeighbours(const FitGroup& group, const PlaceColumns& columns, const ParticleRuns& runs,
  FitNeighbours& neighbours)
{
  std::size_t most = 0;
  for (const ParticleRun& run : runs)
  {
    most += run.End - run.First;
  }
  neighbours.resize(most);
  FitNeighbour* end = neighbours.data();
  RunCompiled(ListKernel{ group, columns, runs, end });
  neighbours.resize(static_cast<std::size_t>(end - neighbours.data()));
}

namespace
{

struct LaneSums
{
  Lanes Weight, Near, First[3];
  LaneMatrix Second;
};

struct FitKernel
{
  const FitLaw& Law;
  const FitGroup& Group;
  const FitNeighbours& Neighbours;
  const WeightColumns& Weights;
  GroupFits& Fits;

  ACTIVE_ALWAYS_INLINE void operator()() const
  {
    LaneSums sums;
    this->AddUp(sums);
    const Lanes zero = AllLanes(0.f), one = AllLanes(1.f);
    // The sum of weights is 0 for a particle that has neither strength nor neighbours.
    const Lanes inverse = one / Pick(sums.Weight > zero, sums.Weight, one);
    Lanes mean[3];
    for (int i = 0; i < 3; ++i)
    {
      mean[i] = sums.First[i] * inverse;
    }
    LaneMatrix covariance;
    for (int i = 0; i < 3; ++i)
    {
      for (int k = i; k < 3; ++k)
      {
        covariance.Of(i, k) = sums.Second.Of(i, k) * inverse - mean[i] * mean[k];
      }
    }
    const LaneEigen eigen(covariance);
    Lanes axes[3];
    for (int i = 0; i < 3; ++i)
    {
      axes[i] = Root(Largest(eigen.Value[i], zero));
    }
    this->Describe(sums, mean, axes, eigen);
  }

private:
  ACTIVE_ALWAYS_INLINE void AddUp(LaneSums& result) const
  {
    const Lanes zero = AllLanes(0.f), one = AllLanes(1.f);
    const Lanes x0 = LoadLanes(this->Group.Place[0]), y0 = LoadLanes(this->Group.Place[1]),
                z0 = LoadLanes(this->Group.Place[2]);
    const Lanes perNear = AllLanes(1.f / (NearPerWide * NearPerWide));
    Lanes w = zero, near = zero, fx = zero, fy = zero, fz = zero;
    Lanes xx = zero, xy = zero, xz = zero, yy = zero, yz = zero, zz = zero;
    for (const FitNeighbour& n : this->Neighbours)
    {
      const Lanes x = AllLanes(n.Place[0]) - x0, y = AllLanes(n.Place[1]) - y0,
                  z = AllLanes(n.Place[2]) - z0;
      const Lanes q = (x * x + y * y + z * z) * AllLanes(this->Weights.InverseWide2[n.Number]);
      const Lanes strength = AllLanes(this->Weights.Strength[n.Number]);
      const Lanes u = Largest(one - q, zero), v = Largest(one - q * perNear, zero);
      const Lanes k = strength * (u * u);
      const Lanes kx = k * x, ky = k * y, kz = k * z;
      w += k;
      near += strength * (v * v);
      fx += kx;
      fy += ky;
      fz += kz;
      xx += kx * x;
      xy += kx * y;
      xz += kx * z;
      yy += ky * y;
      yz += ky * z;
      zz += kz * z;
    }
    result = { w, near, { fx, fy, fz }, { { xx, xy, xz, yy, yz, zz } } };
  }

  ACTIVE_ALWAYS_INLINE void Describe(const LaneSums& sums, const Lanes (&mean)[3],
    const Lanes (&axes)[3], const LaneEigen& eigen) const
  {
    const Lanes zero = AllLanes(0.f), one = AllLanes(1.f);
    const Lanes own = LoadLanes(this->Group.OwnRadius), reach = LoadLanes(this->Group.Reach);
    const Lanes wide = AllLanes(this->Law.WidePerReach) * reach, perWide = one / wide;
    const Lanes cells = wide / (AllLanes(2.f) * own);
    const Lanes others = sums.Weight - LoadLanes(this->Group.Strength);
    const Lanes density = others / (AllLanes(WholeBall) * (cells * cells * cells));
    const Lanes depth = Root(mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]);
    const Lanes bulk = SmoothStep(LeastBody, FullBody, density);
    const Lanes deep = SmoothStep(LeastDepth, FullDepth, depth * perWide);
    const Lanes shape =
      Pick(axes[0] > zero, SmoothStep(FewestNeighbours, EnoughNeighbours, sums.Near), zero);
    const Lanes middle = Largest(axes[1], AllLanes(ThinRatio) * axes[0]);
    const Lanes ratio = Pick(middle > zero, axes[2] / Pick(middle > zero, middle, one), zero);
    const Lanes thin = Largest(one - SmoothStep(TinySize, SmallSize, axes[0] * perWide),
      one - SmoothStep(ThinRatio, ThickRatio, ratio));
    const Lanes far = reach *
      (AllLanes(LeastReach) +
        AllLanes(1.f - LeastReach) * SmoothStep(DensityOfLeastReach, DensityOfFullReach, density));
    const Lanes loss =
      AllLanes(this->Law.HasTriangles ? LossOfTriangles : 0.f) / Largest(own, AllLanes(LeastBall));
    const Lanes ball = own + loss * (one - shape);
    StoreLanes(this->Fits.Bulk, bulk);
    StoreLanes(this->Fits.Deep, deep);
    StoreLanes(this->Fits.Thin, thin);
    StoreLanes(this->Fits.Shape, shape);
    constexpr float most = .999f;
    const Lanes q = Least(ball / far, AllLanes(most)), rest = one - q * q;
    StoreLanes(this->Fits.Lone, rest * rest * rest);
    this->FindPlaces(mean, depth, ball + AllLanes(OffsetOfBody) * own * bulk, eigen);
    this->FindEllipsoid(mean, axes, shape, far, eigen);
  }

  ACTIVE_ALWAYS_INLINE void FindPlaces(
    const Lanes (&mean)[3], const Lanes& depth, const Lanes& offset, const LaneEigen& eigen) const
  {
    const Lanes zero = AllLanes(0.f), one = AllLanes(1.f);
    const Lanes inward =
      eigen.Vector[0][2] * mean[0] + eigen.Vector[1][2] * mean[1] + eigen.Vector[2][2] * mean[2];
    const Lanes perDepth = Pick(depth > zero, one / Pick(depth > zero, depth, one), zero);
    for (int i = 0; i < 3; ++i)
    {
      const Lanes across = Pick(inward > zero, -eigen.Vector[i][2], eigen.Vector[i][2]);
      StoreLanes(this->Fits.Away[i], -(offset * mean[i] * perDepth));
      StoreLanes(this->Fits.Across[i], offset * across);
    }
  }

  // Blends, by `shape`, a ball and an ellipsoid of equal volume in the neighbourhood's proportions.
  ACTIVE_ALWAYS_INLINE void FindEllipsoid(const Lanes (&mean)[3], const Lanes (&axes)[3],
    const Lanes& shape, const Lanes& reach, const LaneEigen& eigen) const
  {
    const Lanes zero = AllLanes(0.f), one = AllLanes(1.f);
    Lanes length[3], inverse2[3];
    for (int i = 0; i < 3; ++i)
    {
      length[i] = Largest(axes[i], axes[0] * AllLanes(1.f / this->Law.Anisotropy));
      length[i] = Pick(shape > zero, length[i], one);
    }
    const Lanes scale = InverseCubeRoot(length[0] * length[1] * length[2]);
    for (int i = 0; i < 3; ++i)
    {
      length[i] = length[i] * scale;
      inverse2[i] = (one - shape) + shape / (length[i] * length[i]);
    }
    const Lanes round = one / (reach * reach);
    for (int i = 0; i < 3; ++i)
    {
      StoreLanes(this->Fits.Offset[i], AllLanes(ShareOfMean) * shape * mean[i]);
      Lanes extent = zero;
      for (int e = 0; e < 3; ++e)
      {
        extent += eigen.Vector[i][e] * eigen.Vector[i][e] / inverse2[e];
      }
      StoreLanes(this->Fits.Extent[i], Root(extent) * reach);
      for (int k = i; k < 3; ++k)
      {
        Lanes sum = zero;
        for (int e = 0; e < 3; ++e)
        {
          sum += eigen.Vector[i][e] * eigen.Vector[k][e] * inverse2[e];
        }
        StoreLanes(this->Fits.Metric[LaneMatrix::At[i][k]], sum * round);
      }
    }
    StoreLanes(this->Fits.Reach, Largest(length[0], one) * reach);
  }
};

template <bool HasGradient>
struct EllipsoidKernel
{
  const FitGroup& Group;
  const FitNeighbours& Neighbours;
  const NodeEllipsoid* Ellipsoids;
  float* Sums;
  float (*Gradients)[8];

  ACTIVE_ALWAYS_INLINE void operator()() const
  {
    const Lanes x0 = LoadLanes(this->Group.Place[0]), y0 = LoadLanes(this->Group.Place[1]),
                z0 = LoadLanes(this->Group.Place[2]);
    const Lanes one = AllLanes(1.f), zero = AllLanes(0.f);
    Lanes sum = zero, gx = zero, gy = zero, gz = zero;
    for (const FitNeighbour& n : this->Neighbours)
    {
      const NodeEllipsoid& e = this->Ellipsoids[n.Number];
      const float* m = e.Metric;
      const Lanes x = x0 - AllLanes(n.Place[0]), y = y0 - AllLanes(n.Place[1]),
                  z = z0 - AllLanes(n.Place[2]);
      const Lanes mx = AllLanes(m[0]) * x + AllLanes(m[1]) * y + AllLanes(m[2]) * z;
      const Lanes my = AllLanes(m[1]) * x + AllLanes(m[3]) * y + AllLanes(m[4]) * z;
      const Lanes mz = AllLanes(m[2]) * x + AllLanes(m[4]) * y + AllLanes(m[5]) * z;
      const Lanes u = Largest(one - (x * mx + y * my + z * mz), zero);
      sum += AllLanes(e.Strength) * (u * u * u);
      if (HasGradient)
      {
        const Lanes rate = AllLanes(-6.f * e.Strength) * (u * u);
        gx += rate * mx;
        gy += rate * my;
        gz += rate * mz;
      }
    }
    StoreLanes(this->Sums, sum);
    if (HasGradient)
    {
      StoreLanes(this->Gradients[0], gx);
      StoreLanes(this->Gradients[1], gy);
      StoreLanes(this->Gradients[2], gz);
    }
  }
};

struct ShareKernel
{
  const FitGroup& Group;
  const FitNeighbours& Neighbours;
  const ShareColumns& Columns;
  float* Shares;
  float* Lacks;

  ACTIVE_ALWAYS_INLINE void operator()() const
  {
    const Lanes x0 = LoadLanes(this->Group.Place[0]), y0 = LoadLanes(this->Group.Place[1]),
                z0 = LoadLanes(this->Group.Place[2]);
    const Lanes one = AllLanes(1.f), zero = AllLanes(0.f);
    Lanes shares = zero, lacks = zero;
    for (const FitNeighbour& n : this->Neighbours)
    {
      const Lanes x = AllLanes(n.Place[0]) - x0, y = AllLanes(n.Place[1]) - y0,
                  z = AllLanes(n.Place[2]) - z0;
      const Lanes q = (x * x + y * y + z * z) * AllLanes(this->Columns.InverseWide2[n.Number]);
      const Lanes u = Largest(one - q, zero);
      const Lanes share = u * u * AllLanes(this->Columns.Share[n.Number]);
      shares += share;
      lacks += share * AllLanes(this->Columns.Lack[n.Number]);
    }
    StoreLanes(this->Shares, shares);
    StoreLanes(this->Lacks, lacks);
  }
};

}

void FindGroupFits(const FitLaw& law, const FitGroup& group, const FitNeighbours& neighbours,
  const WeightColumns& weights, GroupFits& fits)
{
  RunCompiled(FitKernel{ law, group, neighbours, weights, fits });
}

void SumEllipsoids(const FitGroup& group, const FitNeighbours& neighbours,
  const NodeEllipsoid* ellipsoids, float (&sums)[8])
{
  RunCompiled(EllipsoidKernel<false>{ group, neighbours, ellipsoids, sums, nullptr });
}

void SumEllipsoids(const FitGroup& group, const FitNeighbours& neighbours,
  const NodeEllipsoid* ellipsoids, PointSums& sums)
{
  RunCompiled(EllipsoidKernel<true>{ group, neighbours, ellipsoids, sums.Sum, sums.Gradient });
}

void SumShares(const FitGroup& group, const FitNeighbours& neighbours, const ShareColumns& columns,
  float (&shares)[8], float (&lacks)[8])
{
  RunCompiled(ShareKernel{ group, neighbours, columns, shares, lacks });
}

}

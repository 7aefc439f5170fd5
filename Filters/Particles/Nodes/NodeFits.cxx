#include "Nodes/NodeFits.h"

#include "Index/ParallelTasks.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace activesurface
{

// A group and its neighbours; one per thread, reused.
struct NodeFits::Search
{
  NodeIndex Base{}; // positions are relative to the origin of this block
  FitGroup Group;
  ParticleRuns Runs;
  FitNeighbours Neighbours;
};

void NodeFits::Find(const ParticleBlocks& blocks, const FitColumns& given,
  const GhostParticles& ghosts, const NodeFitOptions& options)
{
  this->Blocks = &blocks;
  this->Ghosts = &ghosts;
  this->Given = given;
  this->Options = options;
  const std::size_t count = blocks.GetOrder().size();
  this->Resize(count);
  if (this->HasTooManyNeighbours())
  {
    if (options.HasEllipsoids)
    {
      RefuseNeighbours(count);
    }
    std::fill(this->Bulk.begin(), this->Bulk.end(), 0.f);
    std::fill(this->Deep.begin(), this->Deep.end(), 0.f);
    return;
  }
  const auto isNear = [&ghosts](std::uint32_t k, bool isNearSurface)
  { return isNearSurface && ghosts.IsOwn(k); };
  this->ForEachGroup(isNear, [this](Search& search) { this->FindShapes(search); });
  this->ShareShapes();
  if (!options.HasEllipsoids)
  {
    return;
  }
  this->FindReaches();
  this->ForEachGroup([this](std::uint32_t k, bool isNearSurface)
    { return isNearSurface && this->Ghosts->IsOwn(k) && this->IsAtSurface(k); },
    [this](Search& search) { this->FindLacks(search); });
  this->ShareLacks();
  this->ListSurface();
  this->ForEachGroup(isNear, [this](Search& search) { this->FindStrengths(search); });
  this->ShareStrengths();
}

// Returns true if a sample of particles, evenly spread over the list, has more than MostNeighbours
// neighbours on average; false for at most FewParticles particles.
bool NodeFits::HasTooManyNeighbours() const
{
  const std::size_t count = this->Blocks->GetOrder().size();
  if (count <= FewParticles)
  {
    return false;
  }
  Search search;
  std::size_t neighbours = 0;
  for (std::size_t n = 0; n < ParticlesOfSample; ++n)
  {
    const auto k = static_cast<std::uint32_t>(n * count / ParticlesOfSample);
    search.Base = (*this->Blocks)[this->Blocks->GetBlockOf()[k]].At;
    search.Group.Count = 1;
    search.Group.Members[0] = k;
    this->FillGroup(search);
    this->GatherNeighbours(search);
    neighbours += search.Neighbours.size();
  }
  return neighbours > MostNeighbours * ParticlesOfSample;
}

// Visits groups of up to eight particles. Each parallel task handles those parts of a block that
// have the same x.
template <class IsWanted, class Visit>
void NodeFits::ForEachGroup(IsWanted&& isWanted, Visit&& visit) const
{
  constexpr int side = ParticleBlocks::PartsOfSide;
  RunTasks(side * this->Blocks->Size(),
    [&](std::size_t task)
    {
      thread_local Search search;
      const ParticleBlocks::Block& block = (*this->Blocks)[task / side];
      search.Base = block.At;
      const int x = static_cast<int>(task % side);
      for (int y = 0; y < side; ++y)
      {
        search.Group.Count = 0;
        const auto finish = [&](int least)
        {
          if (search.Group.Count >= least)
          {
            this->FillGroup(search);
            visit(search);
            search.Group.Count = 0;
          }
        };
        for (int z = 0; z < side; ++z)
        {
          const int part = side * side * x + side * y + z;
          const bool isNear = ParticleBlocks::IsNearSurface(block, x, y, z);
          for (std::uint32_t k = block.Starts[part]; k < block.Starts[part + 1]; ++k)
          {
            if (isWanted(k, isNear))
            {
              search.Group.Members[search.Group.Count++] = k;
            }
            finish(8);
          }
        }
        finish(1);
      }
    });
}

void NodeFits::FillGroup(Search& search) const
{
  FitGroup& group = search.Group;
  for (int i = 0; i < 8; ++i)
  {
    const std::uint32_t k = group.Members[std::min(i, group.Count - 1)];
    group.Place[0][i] = this->Given.X[k];
    group.Place[1][i] = this->Given.Y[k];
    group.Place[2][i] = this->Given.Z[k];
    group.OwnRadius[i] = this->Given.OwnRadius[k];
    group.Reach[i] = this->Given.Reach[k];
    group.Strength[i] = std::max(this->Given.Strength[k], 0.f);
  }
}

// Finds the particles whose balls touch the group's box. columns.Reach2: squared radii of the
// balls. rowOf: the row of a particle, or the next row if the particle has none.
template <class RowOf>
void NodeFits::Gather(Search& search, const PlaceColumns& columns,
  const ParticleBlocks::Reaches& reaches, RowOf&& rowOf) const
{
  FitGroup& group = search.Group;
  group.FindBox();
  const NodeIndex& base = search.Base;
  const double size = this->Blocks->GetBlockSize();
  double low[3], high[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double middle = size * base[axis] + group.Middle[axis];
    low[axis] = middle - group.Half[axis];
    high[axis] = middle + group.Half[axis];
  }
  search.Runs.clear();
  this->Blocks->VisitRuns(low, high, reaches,
    [&](std::uint32_t first, std::uint32_t end, const NodeIndex& at)
    {
      ParticleRun run{ rowOf(first), rowOf(end), {} };
      for (int axis = 0; axis < 3; ++axis)
      {
        run.Shift[axis] = static_cast<float>(size * (at[axis] - base[axis]));
      }
      search.Runs.push_back(run);
    });
  ListNeighbours(group, columns, search.Runs, search.Neighbours);
}

void NodeFits::GatherNeighbours(Search& search) const
{
  this->Gather(search, { this->Given.X, this->Given.Y, this->Given.Z, this->Wide2.data() },
    this->WideReaches, [](std::uint32_t k) { return k; });
}

void NodeFits::FindShapes(Search& search)
{
  this->GatherNeighbours(search);
  GroupFits fits;
  const FitLaw law = { static_cast<float>(this->Options.WidePerReach),
    static_cast<float>(this->Options.Anisotropy), this->Options.HasTriangles };
  FindGroupFits(law, search.Group, search.Neighbours,
    { this->InverseWide2.data(), this->Given.Strength }, fits);
  for (int i = 0; i < search.Group.Count; ++i)
  {
    this->KeepShape(search.Group.Members[i], i, fits);
  }
}

void NodeFits::KeepShape(std::uint32_t k, int column, const GroupFits& fits)
{
  const std::uint32_t row = this->Row[k];
  this->Bulk[k] = fits.Bulk[column];
  this->Deep[row] = fits.Deep[column];
  this->Thin[row] = fits.Thin[column];
  this->Shape[row] = fits.Shape[column];
  this->Lone[row] = fits.Lone[column];
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Places[6 * row + axis] = fits.Away[axis][column];
    this->Places[6 * row + 3 + axis] = fits.Across[axis][column];
  }
  if (!(this->Given.Strength[k] > 0.f) || !this->Options.HasEllipsoids)
  {
    return;
  }
  this->EX[row] = this->Given.X[k] + fits.Offset[0][column];
  this->EY[row] = this->Given.Y[k] + fits.Offset[1][column];
  this->EZ[row] = this->Given.Z[k] + fits.Offset[2][column];
  this->EReach2[row] = fits.Reach[column] * fits.Reach[column];
  NodeEllipsoid& ellipsoid = this->Ellipsoids[row];
  for (int i = 0; i < 6; ++i)
  {
    ellipsoid.Metric[i] = fits.Metric[i][column];
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    ellipsoid.Extent[axis] = fits.Extent[axis][column];
  }
  ellipsoid.Strength = this->Given.Strength[k]; // normalized in FindStrengths
}

void NodeFits::FindReaches()
{
  this->Blocks->FindReaches(
    [this](std::uint32_t k)
    {
      const std::uint32_t i = this->Row[k];
      if (!this->HasRow(k) || !(this->EReach2[i] > 0.f))
      {
        return 0.0;
      }
      const float far = std::max({ std::fabs(this->EX[i] - this->Given.X[k]),
        std::fabs(this->EY[i] - this->Given.Y[k]), std::fabs(this->EZ[i] - this->Given.Z[k]) });
      return std::sqrt(static_cast<double>(this->EReach2[i])) + far;
    },
    this->Reaches);
}

// Sets the group's points to the expected surface points Away (place 0) or Across (place 3), see
// GroupFits. Returns true if one of these points has a nonzero weight.
bool NodeFits::PlaceBeside(
  Search& search, const UnsetVector<float>& counting, std::size_t place) const
{
  FitGroup& group = search.Group;
  bool counts = false;
  for (int i = 0; i < 8; ++i)
  {
    const std::uint32_t k = group.Members[std::min(i, group.Count - 1)];
    const float* to = &this->Places[6 * this->Row[k] + place];
    group.Place[0][i] = this->Given.X[k] + to[0];
    group.Place[1][i] = this->Given.Y[k] + to[1];
    group.Place[2][i] = this->Given.Z[k] + to[2];
    counts = counts || counting[this->Row[k]] > 0.f;
  }
  return counts;
}

// FindStrengths divides a particle's strength by the sum of kernels at the particle's points Away
// and Across (see GroupFits). A particle that fades in or out counts fully in its own sums; else an
// isolated particle would not fade. Returns what the sum at Away (place 0) or Across (place 3)
// lacks: (1 - strength) times the particle's kernel.
float NodeFits::FindFaded(std::uint32_t k, std::size_t place) const
{
  const float faded = 1.f - std::max(this->Given.Strength[k], 0.f);
  const std::uint32_t row = this->Row[k];
  if (!(faded > 0.f) || !(this->EReach2[row] > 0.f))
  {
    return 0.f;
  }
  const float* m = this->Ellipsoids[row].Metric;
  const float* to = &this->Places[6 * row + place];
  const float x = this->Given.X[k] + to[0] - this->EX[row];
  const float y = this->Given.Y[k] + to[1] - this->EY[row];
  const float z = this->Given.Z[k] + to[2] - this->EZ[row];
  const float q = x * (m[0] * x + m[1] * y + m[2] * z) + y * (m[1] * x + m[3] * y + m[4] * z) +
    z * (m[2] * x + m[4] * y + m[5] * z);
  const float rest = std::max(1.f - q, 0.f);
  return faded * (rest * rest * rest);
}

// Leaves the sums at 0 if all weights are 0.
void NodeFits::SumBeside(
  Search& search, const UnsetVector<float>& counting, std::size_t place, float (&sums)[8]) const
{
  if (this->PlaceBeside(search, counting, place))
  {
    this->GatherEllipsoids(search);
    SumEllipsoids(search.Group, search.Neighbours, this->Ellipsoids.data(), sums);
  }
}

void NodeFits::GatherEllipsoids(Search& search) const
{
  const EllipsoidColumns columns = this->GetColumns();
  this->Gather(search, { columns.X, columns.Y, columns.Z, columns.Reach2 }, this->Reaches,
    [this](std::uint32_t k) { return this->Row[k]; });
}

void NodeFits::SumAt(const NodeIndex& base, const FitGroup& group, PointSums& sums) const
{
  thread_local Search search;
  search.Base = base;
  search.Group = group;
  this->GatherEllipsoids(search);
  SumEllipsoids(search.Group, search.Neighbours, this->Ellipsoids.data(), sums);
}

void NodeFits::FindLacks(Search& search)
{
  alignas(32) float away[8] = {}, across[8] = {};
  this->SumBeside(search, this->Deep, 0, away);
  this->SumBeside(search, this->Thin, 3, across);
  for (int i = 0; i < search.Group.Count; ++i)
  {
    const std::uint32_t k = search.Group.Members[i], row = this->Row[k];
    const float deep = this->Deep[row], thin = this->Thin[row];
    const float value =
      (deep * (away[i] + this->FindFaded(k, 0)) + thin * (across[i] + this->FindFaded(k, 3))) /
      (deep + thin);
    this->Share[row] = 1.f - (1.f - deep) * (1.f - thin);
    this->Lack[row] = value - this->Lone[row];
  }
}

// Lists the particles whose Share is not 0.
void NodeFits::ListSurface()
{
  const std::size_t count = this->Ellipsoids.size();
  this->SurfaceBefore.resize(count + 1);
  std::uint32_t all = 0;
  for (std::size_t k = 0; k < count; ++k)
  {
    this->SurfaceBefore[k] = all;
    all += this->Share[k] > 0.f ? 1 : 0;
  }
  this->SurfaceBefore[count] = all;
  SurfaceColumns& to = this->Surface;
  for (UnsetVector<float>* numbers :
    { &to.X, &to.Y, &to.Z, &to.Wide2, &to.InverseWide2, &to.Share, &to.Lack })
  {
    numbers->resize(all + LanePadding);
    std::fill_n(numbers->data() + all, LanePadding, 0.f);
  }
  this->Row.ForEach(*this->Blocks,
    [&](std::size_t, std::uint32_t k, std::uint32_t row)
    {
      const std::uint32_t i = this->SurfaceBefore[row];
      if (this->Share[row] > 0.f)
      {
        to.X[i] = this->Given.X[k];
        to.Y[i] = this->Given.Y[k];
        to.Z[i] = this->Given.Z[k];
        to.Wide2[i] = this->Wide2[k];
        to.InverseWide2[i] = this->InverseWide2[k];
        to.Share[i] = this->Given.Strength[k] * this->Share[row];
        to.Lack[i] = this->Lack[row];
      }
    });
}

void NodeFits::FindStrengths(Search& search)
{
  // Lower limit of the sum at a body's surface, divided by the value Lone of an isolated particle.
  // Without this limit, the sum Lone + mean lack could be negative where neighbours have larger
  // supports.
  constexpr float leastShare = .1f;
  const SurfaceColumns& surface = this->Surface;
  this->Gather(search,
    { surface.X.data(), surface.Y.data(), surface.Z.data(), surface.Wide2.data() },
    this->WideReaches, [this](std::uint32_t k) { return this->SurfaceBefore[this->Row[k]]; });
  alignas(32) float shares[8], lacks[8];
  SumShares(search.Group, search.Neighbours,
    { surface.InverseWide2.data(), surface.Share.data(), surface.Lack.data() }, shares, lacks);
  for (int i = 0; i < search.Group.Count; ++i)
  {
    const std::uint32_t k = search.Group.Members[i], row = this->Row[k];
    const float mean = shares[i] > 0.f ? lacks[i] / shares[i] : 0.f;
    const float shape = this->Shape[row], own = this->Share[row] * this->Lack[row];
    const float value =
      this->Lone[row] + shape * mean * std::min(shares[i], 1.f) + (1.f - shape) * own;
    this->Ellipsoids[row].Strength =
      this->Given.Strength[k] / std::max(value, leastShare * this->Lone[row]);
  }
}

void RefuseNeighbours(std::size_t particles)
{
  throw std::invalid_argument(std::to_string(particles) +
    " particles (periodic copies included) have more than " + std::to_string(MostNeighbours) +
    " neighbours within 1.6 kernel radii on average; about 200 are usual. Remove coincident "
    "particles, give ParticleSpacing, KernelRadius or the array of radii in the unit of the "
    "positions, or set "
    "ParticleModel to SUM.");
}

}

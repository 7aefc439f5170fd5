#include "Simulation/SharedFrames.h"

#include "Base/IndexMap.h"
#include "Frames/ParticleBytes.h"
#include "Frames/ParticleFrame.h"
#include "NarrowBand.h"
#include "ParticleNodes.h"
#include "Ranks/Domain.h"
#include "Simulation/TargetBuilder.h"
#include "Targets/NoShape.h"
#include "Targets/OwnedParticles.h"
#include "Targets/ParticleShape.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace activesurface
{

namespace
{

// Indices of the particles of one step that each rank receives.
class ParticleMessages
{
public:
  explicit ParticleMessages(int ranks)
    : Chosen(static_cast<std::size_t>(ranks))
  {
  }

  void Add(std::size_t particle, const std::vector<int>& ranks)
  {
    for (const int rank : ranks)
    {
      this->Chosen[static_cast<std::size_t>(rank)].push_back(static_cast<std::uint32_t>(particle));
    }
  }

  // Returns this rank's particles of the step. Collective.
  std::shared_ptr<ParticleShape> Send(const InputShape& owned) const
  {
    const ParticleFrame& particles = *owned.GetParticles();
    std::vector<Bytes> toEach;
    toEach.reserve(this->Chosen.size());
    for (const ParticleChoice& ofRank : this->Chosen)
    {
      toEach.push_back(PackParticles(particles, ofRank));
    }
    ParticleFrame part =
      MergeParticles(owned.Owned->Ranks.Distribute(std::move(toEach)), particles);
    part.Whole = particles.Whole;
    std::shared_ptr<ParticleShape> shape =
      dynamic_cast<const ParticleShape&>(owned).MakeOther(std::move(part));
    shape->Owned = owned.Owned;
    return shape;
  }

private:
  std::vector<ParticleChoice> Chosen; // by rank
};

}

void SharedFrames::Add(int step, const std::shared_ptr<InputShape>& shape)
{
  this->OwnedFrames.Add(step, shape->Owned ? shape : std::make_shared<NoShape>());
}

bool SharedFrames::ArePlaceable(int first, int last) const
{
  for (int step = first; step <= last; ++step)
  {
    const InputShape* shape = this->OwnedFrames.Find(step);
    if (!shape || !shape->Owned)
    {
      return false;
    }
  }
  return true;
}

void SharedFrames::Place(NarrowBand& band, int first, int last)
{
  if (!this->ArePlaceable(first, last))
  {
    this->MakeWhole(first, last);
    band.MakeWhole();
    return;
  }
  const std::shared_ptr<const Domain> space = this->ShareSpace(band, last);
  this->Send(first, last, last > first ? this->MatchOwned(first) : ParticleMatches(), *space);
  band.SetDomain(space);
}

void SharedFrames::MakeWhole(int first, int last)
{
  for (int step = first; step <= last; ++step)
  {
    const InputShape* part = this->Shapes.GetFrames().Find(step);
    if (part && part->Owned)
    {
      this->Shapes.Add(step, GatherShape(*this->OwnedFrames.Find(step)));
    }
  }
}

// Partitions space so that the ranks have equal costs. Each particle of the step `last` costs 1;
// NarrowBand::ListCosts adds the costs of the band's leaves.
std::shared_ptr<const Domain> SharedFrames::ShareSpace(const NarrowBand& band, int last) const
{
  const InputShape& shape = *this->OwnedFrames.Find(last);
  const double voxelSize = band.GetVoxelSize();
  IndexMap leaves;
  std::vector<LeafCost> costs;
  for (const SkeletonVertex& particle : shape.GetParticles()->Particles)
  {
    NodeIndex leaf = NodeBelow(particle.Position, voxelSize);
    for (int& place : leaf)
    {
      place &= ~7;
    }
    const auto i = static_cast<std::size_t>(leaves.Add(leaf));
    if (i == costs.size())
    {
      costs.push_back({ leaf, 0.0 });
    }
    costs[i].Cost += 1.0;
  }
  band.ListCosts(costs);
  return Domain::Share(shape.Owned->Ranks, std::move(costs));
}

// Matches the particles that this rank owns. All ranks decide together whether particles are
// shuffled. Collective.
ParticleMatches SharedFrames::MatchOwned(int first) const
{
  const ParticleFrame& earlier = *this->OwnedFrames.Find(first)->GetParticles();
  const ParticleFrame& later = *this->OwnedFrames.Find(first + 1)->GetParticles();
  const PeriodicBox noBox;
  ParticleMatches matches = PairParticles(earlier, later, false);
  std::vector<NumberedDisplacement> displacements =
    this->OwnedFrames.Find(first)->Owned->Ranks.ExchangeValues(
      SampleDisplacements(earlier, later, matches.Partners, noBox));
  return AreShuffled(std::move(displacements), earlier, noBox) ? PairParticles(earlier, later, true)
                                                               : matches;
}

// Sends each particle, with its data at both steps, to all ranks that may need the particle between
// the steps. The partition of such a rank meets the box around the particle's two positions,
// enlarged by the margin.
void SharedFrames::Send(int first, int last, const ParticleMatches& matches, const Domain& space)
{
  const InputShape& earlier = *this->OwnedFrames.Find(first);
  const InputShape* later = last > first ? this->OwnedFrames.Find(last) : nullptr;
  const ParticleFrame& from = *earlier.GetParticles();
  const double voxelSize = this->Shapes.FindDomain()->VoxelSize;
  const int margin = this->Shapes.FindMarginOfRanks(), size = space.GetRanks().GetSize();
  ParticleMessages messages[2] = { ParticleMessages(size), ParticleMessages(size) };
  std::vector<int> ranks;
  const auto list = [&](const NodeIndex& a, const NodeIndex& b)
  {
    NodeIndex low, high;
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(a[axis], b[axis]) - margin;
      high[axis] = std::max(a[axis], b[axis]) + margin;
    }
    space.ListOwners(low, high, ranks);
  };
  for (std::size_t i = 0; i < from.Particles.size(); ++i)
  {
    const NodeIndex node = NodeBelow(from.Particles[i].Position, voxelSize);
    const std::size_t partner = later ? matches.Partners[i] : NoPartner;
    list(node,
      partner == NoPartner
        ? node
        : NodeBelow(later->GetParticles()->Particles[partner].Position, voxelSize));
    messages[0].Add(i, ranks);
    if (partner != NoPartner)
    {
      messages[1].Add(partner, ranks);
    }
  }
  for (const std::size_t birth : matches.Births)
  {
    const ParticleFrame& to = *later->GetParticles();
    const NodeIndex node = NodeBelow(to.Particles[birth].Position, voxelSize);
    list(node, node);
    messages[1].Add(birth, ranks);
  }
  const std::shared_ptr<ParticleShape> own = messages[0].Send(earlier);
  this->Shapes.SetPart(first, own);
  if (later)
  {
    const std::shared_ptr<ParticleShape> next = messages[1].Send(*later);
    this->Shapes.SetPart(last, next);
    this->Shapes.SetPair(first, own, next, matches.AreShuffled);
  }
}

}

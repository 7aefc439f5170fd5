// The particles near a rank's partition: own particles, and ghosts, which other ranks own and
// update.

#ifndef GhostParticles_h
#define GhostParticles_h

#include "Base/NodeTarget.h"
#include "Index/UnsetVector.h"
#include "Ranks/Domain.h"
#include "Ranks/RankBytes.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace activesurface
{

class GhostParticles
{
public:
  // Lists the particles near this rank's partition. domain: null if this rank owns all particles.
  // nodeOf: a particle's position [voxels], rounded down. margin: distance from the partition along
  // each axis [nodes].
  void Find(const Domain* domain, int margin, std::size_t count,
    const std::function<NodeIndex(std::size_t)>& nodeOf);

  // Indices of the listed particles, ascending; empty without a domain.
  const std::vector<std::uint32_t>& GetListed() const { return this->Listed; }

  // Sets the column of each listed particle. order: for each column, the particle's index in
  // GetListed().
  void SetOrder(const UnsetVector<std::uint32_t>& order);

  // Returns true if this rank owns the particle of column k.
  bool IsOwn(std::uint32_t k) const { return this->Own.empty() || this->Own[k]; }

  // Collective. Sends get(k) of own particles to the ranks that have the particle as a ghost. These
  // ranks call set(k, value) with their own k. Does nothing without a domain.
  template <class Value, class Get, class Set>
  void Share(Get&& get, Set&& set) const
  {
    if (!this->Space)
    {
      return;
    }
    std::vector<Bytes> toEach;
    std::vector<std::size_t> sizes;
    toEach.reserve(this->Sent.size());
    sizes.reserve(this->Sent.size());
    for (std::size_t rank = 0; rank < this->Sent.size(); ++rank)
    {
      std::vector<Value> values;
      values.reserve(this->Sent[rank].size());
      for (const std::uint32_t listed : this->Sent[rank])
      {
        values.push_back(get(this->Places[listed]));
      }
      toEach.push_back(ToBytes(values));
      sizes.push_back(this->Received[rank].size() * sizeof(Value));
    }
    const std::vector<Bytes> fromEach =
      this->Space->GetRanks().Distribute(std::move(toEach), sizes);
    for (std::size_t rank = 0; rank < fromEach.size(); ++rank)
    {
      const std::vector<Value> values = FromBytes<Value>(fromEach[rank]);
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        set(this->Places[this->Received[rank][i]], values[i]);
      }
    }
  }

private:
  using Lists = std::vector<std::vector<std::uint32_t>>;

  const Domain* Space = nullptr;
  std::vector<std::uint32_t> Listed;
  std::vector<char> IsOwnListed;
  Lists Sent, Received; // by rank, indices in Listed, in the same order on both ranks
  std::vector<std::uint32_t> Places;
  std::vector<char> Own; // by column; empty: all
};

}

#endif

// The particles of a rank near its space: its own, and those of other ranks, ghosts, of which their
// owners send what they have found.

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
  // Lists the particles near this rank's space. Null: all are this rank's. nodeOf: the node below a
  // particle. margin: distance along each axis from it [nodes].
  void Find(const Domain* domain, int margin, std::size_t count,
    const std::function<NodeIndex(std::size_t)>& nodeOf);

  // Numbers of the listed particles, ascending; nothing without a domain.
  const std::vector<std::uint32_t>& GetListed() const { return this->Listed; }

  // Says where each listed particle is in the columns that follow. order: the particle at each
  // place.
  void SetOrder(const UnsetVector<std::uint32_t>& order);

  // Returns true if this rank owns the particle at a place of the columns.
  bool IsOwn(std::uint32_t k) const { return this->Own.empty() || this->Own[k]; }

  // Sends get(k) of own particles, and calls set(k, value) for ghosts. Collective; does nothing
  // without a domain.
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
  Lists Sent, Received; // by rank, numbers among those listed, in the same order on both ranks
  std::vector<std::uint32_t> Places;
  std::vector<char> Own; // by place; empty: all
};

}

#endif

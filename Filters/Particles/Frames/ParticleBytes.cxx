#include "Frames/ParticleBytes.h"

#include "Frames/ParticleOrder.h"
#include "Ranks/RankBytes.h"

#include <algorithm>
#include <array>

namespace activesurface
{

namespace
{

using Triple = std::array<double, 3>;
using SingleTriple = std::array<float, 3>;

struct PackedHead
{
  std::uint64_t Count;
  std::uint32_t IsSingle, HasStrengths, HasVelocities, Unused;
};

template <class Value, class Get>
void Append(const ParticleChoice& chosen, Bytes& bytes, Get&& get)
{
  std::vector<Value> values;
  values.reserve(chosen.size());
  for (const std::uint32_t i : chosen)
  {
    values.push_back(get(i));
  }
  AppendBytes(values, bytes);
}

template <class Place>
void AppendPlaces(const ParticleList& particles, const ParticleChoice& chosen, Bytes& bytes)
{
  using Number = typename Place::value_type;
  Append<Place>(chosen, bytes,
    [&particles](std::uint32_t i)
    {
      const SkeletonVertex particle = particles[i];
      return Place{ static_cast<Number>(particle.Position[0]),
        static_cast<Number>(particle.Position[1]), static_cast<Number>(particle.Position[2]) };
    });
}

// Reads positions, ids and, if present, strengths. Adds the particles to the frame.
template <class Place>
void ReadParticlesOf(const PackedHead& head, BytesReader& reader, ParticleFrame& frame)
{
  const auto places = reader.Read<Place>(head.Count);
  const auto ids = reader.Read<std::int64_t>(head.Count);
  const auto strengths = reader.Read<double>(head.HasStrengths ? head.Count : 0);
  frame.Ids.insert(frame.Ids.end(), ids.begin(), ids.end());
  SkeletonVertex particle;
  particle.Radius = particle.Strength = 1.0;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    std::copy(places[i].begin(), places[i].end(), particle.Position);
    particle.Strength = head.HasStrengths ? strengths[i] : 1.0;
    frame.Particles.Add(particle);
  }
}

void AddPacked(const Bytes& bytes, ParticleFrame& frame)
{
  BytesReader reader(bytes);
  const PackedHead head = reader.Read<PackedHead>(1).front();
  head.IsSingle ? ReadParticlesOf<SingleTriple>(head, reader, frame)
                : ReadParticlesOf<Triple>(head, reader, frame);
  if (head.HasVelocities)
  {
    const auto velocities = reader.Read<Triple>(head.Count);
    frame.Velocities.insert(frame.Velocities.end(), velocities.begin(), velocities.end());
    frame.HasVelocities = true;
  }
}

}

Bytes PackParticles(const ParticleFrame& frame, const ParticleChoice& chosen)
{
  const ParticleList& particles = frame.Particles;
  if (chosen.empty())
  {
    return {};
  }
  const PackedHead head = { chosen.size(), particles.AreSingle() ? 1u : 0u,
    particles.HaveStrengths() ? 1u : 0u, frame.HasVelocities ? 1u : 0u, 0u };
  Bytes bytes = ToBytes(std::vector<PackedHead>{ head });
  head.IsSingle ? AppendPlaces<SingleTriple>(particles, chosen, bytes)
                : AppendPlaces<Triple>(particles, chosen, bytes);
  Append<std::int64_t>(chosen, bytes, [&frame](std::uint32_t i) { return frame.Ids[i]; });
  if (head.HasStrengths)
  {
    Append<double>(
      chosen, bytes, [&particles](std::uint32_t i) { return particles.GetGivenStrength(i); });
  }
  if (head.HasVelocities)
  {
    Append<Triple>(chosen, bytes, [&frame](std::uint32_t i) { return frame.Velocities[i]; });
  }
  return bytes;
}

ParticleFrame MergeParticles(const std::vector<Bytes>& parts, const ParticleFrame& like)
{
  std::size_t count = 0;
  bool areSingle = true;
  for (const Bytes& bytes : parts)
  {
    if (!bytes.empty())
    {
      const PackedHead head = BytesReader(bytes).Read<PackedHead>(1).front();
      count += head.Count;
      areSingle = areSingle && head.IsSingle;
    }
  }
  ParticleFrame frame;
  frame.HasIds = like.HasIds;
  frame.HasVelocities = like.HasVelocities;
  frame.Ids.reserve(count);
  frame.Particles.Reserve(count, areSingle);
  for (const Bytes& bytes : parts)
  {
    if (!bytes.empty())
    {
      AddPacked(bytes, frame);
    }
  }
  const std::vector<std::size_t> order =
    FindParticleOrder(frame.Particles, frame.HasIds ? &frame.Ids : nullptr);
  if (!order.empty())
  {
    frame.Permute(order);
  }
  frame.GiveRadius(like.Particles.GetCommonRadius());
  return frame;
}

}

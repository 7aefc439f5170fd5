#include "Surface/SkinEvents.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace activesurface
{

namespace
{

/** Bodies, before and after the interval, that equal or neighbouring blocks connect. */
struct Family
{
  std::vector<double> Before; //< volumes
  std::vector<double> After;
};

/** Sets of parts that equal or neighbouring blocks connect. Parts of `after` are numbered after the
 * parts of `before`. */
class Kinship
{
public:
  Kinship(const std::vector<SkinPart>& before, const std::vector<SkinPart>& after)
    : Parent(before.size() + after.size())
  {
    std::iota(this->Parent.begin(), this->Parent.end(), std::size_t(0));
    std::vector<Place> places;
    for (std::size_t p = 0; p < before.size(); ++p)
    {
      for (const PartBlock& block : before[p].Blocks)
      {
        places.push_back({ block, p });
      }
    }
    std::sort(places.begin(), places.end(),
      [](const Place& a, const Place& b) { return a.Block < b.Block; });
    for (std::size_t p = 0; p < after.size(); ++p)
    {
      for (const PartBlock& block : after[p].Blocks)
      {
        this->JoinAround(block, before.size() + p, before, after[p].IsVoid(), places);
      }
    }
  }

  std::size_t Find(std::size_t part) const
  {
    while (this->Parent[part] != part)
    {
      part = this->Parent[part];
    }
    return part;
  }

private:
  struct Place
  {
    PartBlock Block;
    std::size_t Part;
  };

  // Joins a part with the parts around a block. Blocks that differ only along z are consecutive in
  // the sorted list.
  void JoinAround(const PartBlock& block, std::size_t part, const std::vector<SkinPart>& before,
    bool isVoid, const std::vector<Place>& places)
  {
    for (int n = 0; n < 9; ++n)
    {
      const PartBlock first = { block[0] + n / 3 - 1, block[1] + n % 3 - 1, block[2] - 1 };
      const PartBlock last = { first[0], first[1], block[2] + 1 };
      for (auto place = std::lower_bound(places.begin(), places.end(), first,
             [](const Place&a, const PartBlock&b) { return a.Block < b; });
           place != places.end() && place->Block <= last; ++place)
      {
        if (before[place->Part].IsVoid() == isVoid)
        {
          const std::size_t a = this->Find(place->Part), b = this->Find(part);
          this->Parent[std::max(a, b)] = std::min(a, b);
        }
      }
    }
  }

  std::vector<std::size_t> Parent;
};

std::vector<Family> FindFamilies(
  const std::vector<SkinPart>& before, const std::vector<SkinPart>& after)
{
  const Kinship kinship(before, after);
  std::map<std::size_t, Family> families;
  for (std::size_t p = 0; p < before.size() + after.size(); ++p)
  {
    const bool isBefore = p < before.size();
    const SkinPart& part = isBefore ? before[p] : after[p - before.size()];
    if (!part.IsVoid())
    {
      Family& family = families[kinship.Find(p)];
      (isBefore ? family.Before : family.After).push_back(part.Volume);
    }
  }
  std::vector<Family> all;
  all.reserve(families.size());
  for (const auto& [first, family] : families)
  {
    all.push_back(family);
  }
  return all;
}

double Sum(const std::vector<double>& volumes)
{
  return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

/** Returns true if the remaining bodies have gained at least half of the volume of the missing
 * bodies. The smallest bodies of Before are assumed to be missing. After must have fewer bodies
 * than Before. */
bool HasMerged(Family family)
{
  std::sort(family.Before.begin(), family.Before.end());
  const std::size_t missing = family.Before.size() - family.After.size();
  const double lost = std::accumulate(
    family.Before.begin(), family.Before.begin() + static_cast<std::ptrdiff_t>(missing), 0.0);
  return !family.After.empty() && Sum(family.After) >= Sum(family.Before) - 0.5 * lost;
}

std::int64_t CountVoids(const std::vector<SkinPart>& parts)
{
  return std::count_if(parts.begin(), parts.end(), [](const SkinPart& p) { return p.IsVoid(); });
}

/** Returns the number of handles of all parts. */
std::int64_t CountHoles(const std::vector<SkinPart>& parts)
{
  std::int64_t holes = 0;
  for (const SkinPart& part : parts)
  {
    holes += 1 - part.EulerCharacteristic / 2;
  }
  return holes;
}

}

std::string FindEvents(const std::vector<SkinPart>& before, const std::vector<SkinPart>& after)
{
  bool merge = false, split = false;
  int gone = 0, come = 0;
  for (const Family& family : FindFamilies(before, after))
  {
    const int fewer =
      static_cast<int>(family.Before.size()) - static_cast<int>(family.After.size());
    const bool merged = fewer > 0 && HasMerged(family);
    merge = merge || merged;
    split = split || (fewer < 0 && !family.Before.empty());
    gone += fewer > 0 && !merged ? fewer : 0;
    come += family.Before.empty() ? -fewer : 0;
  }
  // A birth cancels a vanishing: the body may have moved farther than blocks can detect.
  const bool vanish = gone > come, birth = come > gone;
  const std::int64_t voids = CountVoids(after) - CountVoids(before);
  const std::int64_t holes = CountHoles(after) - CountHoles(before);
  const std::pair<bool, const char*> all[] = { { merge, "merge" }, { split, "split" },
    { vanish, "vanish" }, { birth, "birth" }, { voids > 0, "void opens" },
    { voids < 0, "void closes" }, { holes > 0, "hole opens" }, { holes < 0, "hole closes" } };
  std::string events;
  for (const auto& [happened, name] : all)
  {
    events += happened ? (events.empty() ? "" : ", ") + std::string(name) : "";
  }
  return events;
}

}

// Values that ranks have of numbered things, each rank of some of them.

#ifndef NumberedValues_h
#define NumberedValues_h

#include "SharedResults.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace activesurface
{

// Of the values that this rank has, by their ascending numbers, those of some numbers: on all ranks
// those that any of them has, ascending. `wanted` ascends; each is on one rank. A round of ranks.
template <class Value>
std::vector<Value> GatherNumbered(Agreement& ranks, const std::vector<std::size_t>& numbers,
  const std::vector<Value>& values, const std::vector<std::size_t>& wanted)
{
  struct Found
  {
    std::size_t Place;
    Value What;
  };
  std::vector<Found> own;
  for (std::size_t n = 0; n < wanted.size(); ++n)
  {
    const auto found = std::lower_bound(numbers.begin(), numbers.end(), wanted[n]);
    if (found != numbers.end() && *found == wanted[n])
    {
      own.push_back({ n, values[static_cast<std::size_t>(found - numbers.begin())] });
    }
  }
  std::vector<Value> all(wanted.size());
  for (const Found& found : GatherLists(ranks, own))
  {
    all[found.Place] = found.What;
  }
  return all;
}

// The values by whose numbers each rank is asked, in that order, of those that it has: numbers,
// which ascend, and values are those of this rank. Rounds of ranks.
template <class Values>
auto AnswerNumbered(Agreement& ranks, const std::vector<std::vector<std::size_t>>& asked,
  const std::vector<std::size_t>& numbers, const Values& values)
{
  using Value = typename Values::value_type;
  const std::vector<std::vector<std::size_t>> ofEach = SwapLists(ranks, asked);
  std::vector<std::vector<Value>> answers(ofEach.size());
  for (std::size_t rank = 0; rank < ofEach.size(); ++rank)
  {
    for (const std::size_t number : ofEach[rank])
    {
      const auto found = std::lower_bound(numbers.begin(), numbers.end(), number);
      answers[rank].push_back(values[static_cast<std::size_t>(found - numbers.begin())]);
    }
  }
  return SwapLists(ranks, std::move(answers));
}

// Values on their way to ranks, each to one, where they are put in the order of their numbers.
class NumberedMove
{
public:
  // to: the rank that each goes to. Rounds of ranks.
  NumberedMove(Agreement& ranks, std::vector<int> to, const std::vector<std::size_t>& numbers)
    : Ranks(ranks)
    , To(std::move(to))
  {
    const std::vector<std::size_t> there = this->Swap(numbers);
    this->Order.resize(there.size());
    std::iota(this->Order.begin(), this->Order.end(), std::size_t(0));
    std::sort(this->Order.begin(), this->Order.end(),
      [&there](std::size_t a, std::size_t b) { return there[a] < there[b]; });
    this->Numbers = this->Sort(there);
  }

  // Of those that have come to this rank.
  const std::vector<std::size_t>& GetNumbers() const { return this->Numbers; }

  // A value of each that was here: of each that has come. A round of ranks.
  template <class Value>
  std::vector<Value> Bring(const std::vector<Value>& values) const
  {
    return this->Sort(this->Swap(values));
  }

private:
  template <class Value>
  std::vector<Value> Swap(const std::vector<Value>& values) const
  {
    std::vector<std::vector<Value>> toEach(static_cast<std::size_t>(this->Ranks.GetSize()));
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      toEach[static_cast<std::size_t>(this->To[i])].push_back(values[i]);
    }
    return SwapAll(this->Ranks, std::move(toEach));
  }

  template <class Value>
  std::vector<Value> Sort(const std::vector<Value>& values) const
  {
    std::vector<Value> sorted;
    sorted.reserve(values.size());
    for (const std::size_t place : this->Order)
    {
      sorted.push_back(values[place]);
    }
    return sorted;
  }

  Agreement& Ranks;
  std::vector<int> To;
  std::vector<std::size_t> Order; // of what comes, by the ranks that it comes from
  std::vector<std::size_t> Numbers;
};

}

#endif

/**
 * Results that ranks make together: each a part of them, and each has all in the end.
 */
#ifndef SharedResults_h
#define SharedResults_h

#include "Agreement.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace activesurface
{

/** Counts the bytes of what is passed. */
class ByteCounter
{
public:
  template <class Value>
  void operator()(const Value*, std::size_t count)
  {
    this->Size += count * sizeof(Value);
  }
  std::size_t GetSize() const { return this->Size; }

private:
  std::size_t Size = 0;
};

/** Appends what is passed to bytes. */
class ByteWriter
{
public:
  explicit ByteWriter(Bytes& bytes)
    : Written(bytes)
  {
  }

  template <class Value>
  void operator()(const Value* values, std::size_t count)
  {
    const std::size_t begin = this->Written.size(), length = count * sizeof(Value);
    this->Written.resize(begin + length);
    if (length > 0)
    {
      std::memcpy(this->Written.data() + begin, values, length);
    }
  }

private:
  Bytes& Written;
};

/** Passes a vector of any size. */
template <class Value, class Pass>
void PassVector(std::vector<Value>& values, Pass& pass)
{
  std::size_t size = values.size();
  pass(&size, 1);
  values.resize(size);
  pass(values.data(), size);
}

/** What visit passes of some numbers. */
template <class Number, class Visit>
Bytes WriteResults(const std::vector<Number>& numbers, Visit&& visit)
{
  ByteCounter count;
  for (const Number n : numbers)
  {
    visit(static_cast<std::size_t>(n), count);
  }
  Bytes bytes;
  bytes.reserve(count.GetSize());
  ByteWriter write(bytes);
  for (const Number n : numbers)
  {
    visit(static_cast<std::size_t>(n), write);
  }
  return bytes;
}

/** Sets what is passed from bytes. */
class ByteReader
{
public:
  explicit ByteReader(const Bytes& bytes)
    : Source(bytes)
  {
  }

  template <class Value>
  void operator()(Value* values, std::size_t count)
  {
    const std::size_t size = count * sizeof(Value);
    if (size > this->Source.size() - this->Done)
    {
      throw std::runtime_error("The ranks are not at the same place: one of them has told less "
                               "than the others need. Update all ranks together, with the same "
                               "inputs.");
    }
    if (size > 0) // or values may be null
    {
      std::memcpy(values, this->Source.data() + this->Done, size);
    }
    this->Done += size;
  }

private:
  const Bytes& Source;
  std::size_t Done = 0;
};

/** Ranges of so many results, one for each rank. */
struct RankRanges
{
  std::size_t Count;
  std::size_t Ranks;

  std::size_t FirstOf(std::size_t rank) const
  {
    return this->Count / this->Ranks * rank + std::min(rank, this->Count % this->Ranks);
  }

  /** The numbers of those of a rank that are told in a round. */
  std::vector<std::size_t> ListRound(std::size_t rank, std::size_t round) const
  {
    const std::size_t end = this->FirstOf(rank + 1);
    const std::size_t first = std::min(this->FirstOf(rank) + round * InRound, end);
    std::vector<std::size_t> numbers(std::min(InRound, end - first));
    std::iota(numbers.begin(), numbers.end(), first);
    return numbers;
  }

  std::size_t CountRounds() const { return (this->FirstOf(1) + InRound - 1) / InRound; }

private:
  static constexpr std::size_t InRound = 16384; //< so that messages take little memory
};

/** Each rank makes its range of so many results, by make(first, end), and is told the others;
 * visit(number, pass) names what a result is, by pass(values, count). Without ranks, all are made.
 */
template <class Make, class Visit>
void ShareResults(Agreement* ranks, std::size_t count, Make&& make, Visit&& visit)
{
  if (!ranks || ranks->IsAlone())
  {
    make(std::size_t{ 0 }, count);
    return;
  }
  const RankRanges ranges{ count, static_cast<std::size_t>(ranks->GetSize()) };
  const auto own = static_cast<std::size_t>(ranks->GetRank());
  make(ranges.FirstOf(own), ranges.FirstOf(own + 1));
  for (std::size_t round = 0; round < ranges.CountRounds(); ++round)
  {
    const std::vector<Bytes> all =
      ranks->Exchange(WriteResults(ranges.ListRound(own, round), visit));
    for (std::size_t rank = 0; rank < ranges.Ranks; ++rank)
    {
      ByteReader read(all[rank]);
      for (const std::size_t n :
        rank != own ? ranges.ListRound(rank, round) : std::vector<std::size_t>())
      {
        visit(n, read);
      }
    }
  }
}

/** Values of one kind as bytes, and back. */
template <class Value>
Bytes ToBytes(const std::vector<Value>& values)
{
  static_assert(std::is_trivially_copyable_v<Value>, "or its bytes are not all of it");
  Bytes bytes;
  ByteWriter write(bytes);
  write(values.data(), values.size());
  return bytes;
}
template <class Value>
std::vector<Value> FromBytes(const Bytes& bytes)
{
  std::vector<Value> values(bytes.size() / sizeof(Value));
  ByteReader read(bytes);
  read(values.data(), values.size());
  return values;
}

/** Lists, one after another. */
template <class Value>
std::vector<Value> Join(const std::vector<std::vector<Value>>& lists)
{
  std::size_t count = 0;
  for (const std::vector<Value>& list : lists)
  {
    count += list.size();
  }
  std::vector<Value> all;
  all.reserve(count);
  for (const std::vector<Value>& list : lists)
  {
    all.insert(all.end(), list.begin(), list.end());
  }
  return all;
}

/** The value of each rank, by rank; values are plain. */
template <class Value>
std::vector<Value> GatherValues(Agreement& ranks, const Value& own)
{
  std::vector<Value> all;
  for (const Bytes& ofRank : ranks.Exchange(ToBytes(std::vector<Value>{ own })))
  {
    all.push_back(FromBytes<Value>(ofRank).at(0));
  }
  return all;
}

/** A list for each rank, and those that each has for this one. */
template <class Value>
std::vector<std::vector<Value>> SwapLists(Agreement& ranks, std::vector<std::vector<Value>> toEach)
{
  std::vector<Bytes> told(toEach.size());
  std::vector<std::size_t> lengths;
  const auto own = static_cast<std::size_t>(ranks.GetRank());
  for (std::size_t rank = 0; rank < toEach.size(); ++rank)
  {
    told[rank] = rank != own ? ToBytes(toEach[rank]) : Bytes();
    lengths.push_back(told[rank].size());
  }
  std::vector<std::size_t> expected;
  for (const Bytes& ofRank : ranks.Exchange(ToBytes(lengths)))
  {
    expected.push_back(FromBytes<std::size_t>(ofRank).at(own));
  }
  std::vector<std::vector<Value>> fromEach;
  for (const Bytes& bytes : ranks.Swap(told, expected))
  {
    fromEach.push_back(FromBytes<Value>(bytes));
  }
  fromEach[own].swap(toEach[own]); // is not passed on
  return fromEach;
}

/** The same, one after another by rank. */
template <class Value>
std::vector<Value> SwapAll(Agreement& ranks, std::vector<std::vector<Value>> toEach)
{
  return Join(SwapLists(ranks, std::move(toEach)));
}

/** The lists of all ranks, one after another by rank. */
template <class Value>
std::vector<Value> GatherLists(Agreement& ranks, const std::vector<Value>& own)
{
  std::vector<std::vector<Value>> lists;
  for (const Bytes& ofRank : ranks.Exchange(ToBytes(own)))
  {
    lists.push_back(FromBytes<Value>(ofRank));
  }
  return Join(lists);
}

/** What each rank has, by rank; visit(value, pass) names what it is. */
template <class Value, class Visit>
std::vector<Value> GatherResults(Agreement& ranks, const Value& own, Visit&& visit)
{
  std::vector<Value> all(static_cast<std::size_t>(ranks.GetSize()));
  ShareResults(
    &ranks, all.size(), [&](std::size_t rank, std::size_t) { all[rank] = own; },
    [&](std::size_t rank, auto& pass) { visit(all[rank], pass); });
  return all;
}

}

#endif

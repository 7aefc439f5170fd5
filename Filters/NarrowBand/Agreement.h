/**
 * Rounds in which ranks tell each other something, fail together, or stop together.
 *
 * Every rank takes part in the same rounds in the same order. A rank that has failed takes part in
 * the next one by Fail, whatever round it is: then the round ends with a RankError on all of them,
 * which has the same sentence everywhere. So no rank waits for one that has gone. A rank whose
 * process has ended takes no part; that is for MPI to notice.
 */
#ifndef Agreement_h
#define Agreement_h

#include "ActiveNarrowBandExport.h"
#include "Communicator.h"
#include "RankBytes.h"

#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace activesurface
{

/** What all ranks have agreed upon to fail with. */
class ACTIVENARROWBAND_EXPORT RankError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/** Memory has ended on one of them. */
class ACTIVENARROWBAND_EXPORT RankMemoryError : public RankError
{
public:
  using RankError::RankError;
};

/** Whether memory has ended, here or on another rank. */
ACTIVENARROWBAND_EXPORT bool IsOfMemory(const std::exception& error);

class ACTIVENARROWBAND_EXPORT Agreement
{
public:
  /** Of a program of one process. */
  Agreement();
  /** Copies share the communicator. */
  explicit Agreement(std::shared_ptr<Communicator> ranks);

  int GetRank() const { return this->Ranks->GetRank(); }
  int GetSize() const { return this->Ranks->GetSize(); }
  bool IsAlone() const { return this->GetSize() < 2; }

  /** A round: the bytes of each rank, by rank. Throws RankError if one has failed. */
  std::vector<Bytes> Exchange(const Bytes& own) const;

  ///@{
  /** A round: sends bytes to each rank and returns those that each has sent to this one, by rank;
   * the second where each rank knows how many come from each. Throw RankError if one has failed. */
  std::vector<Bytes> Distribute(std::vector<Bytes> toEach) const;
  std::vector<Bytes> Distribute(
    std::vector<Bytes> toEach, const std::vector<std::size_t>& sizes) const;
  ///@}

  /** A round: the bytes of each rank on the first one, nothing on others. */
  std::vector<Bytes> GatherToFirst(Bytes own) const;

  ///@{
  /** A round: the value of each rank, by rank; and the values of all, those of a rank after those
   * of the ranks before. */
  template <class Value>
  std::vector<Value> ExchangeValue(const Value& own) const
  {
    return this->ExchangeValues(std::vector<Value>{ own });
  }
  template <class Value>
  std::vector<Value> ExchangeValues(const std::vector<Value>& own) const
  {
    std::vector<Value> all;
    for (const Bytes& bytes : this->Exchange(ToBytes(own)))
    {
      const std::vector<Value> values = FromBytes<Value>(bytes);
      all.insert(all.end(), values.begin(), values.end());
    }
    return all;
  }
  ///@}

  /** A round: whether every rank wants to go on. Throws RankError if one has failed. */
  bool GoOn(bool own) const;

  /** In place of whatever round the others are in. The sentence of the first rank that has failed,
   * after the rank's number, unless all have failed with the same sentence. */
  [[noreturn]] void Fail(const std::string& sentence) const;
  /** The same where memory has ended: a RankMemoryError on all. */
  [[noreturn]] void FailForMemory() const;

private:
  std::vector<std::int64_t> Begin(std::int64_t own) const;
  [[noreturn]] void ThrowTogether(const std::string& sentence) const;

  std::shared_ptr<Communicator> Ranks;
};

/** Runs a task on every rank, which may have rounds of its own: what goes wrong on one rank goes
 * wrong on all. Each waits for the others at the end, or a late error of one would find them gone.
 */
template <class Task>
void RunTogether(const Agreement& ranks, Task&& task)
{
  try
  {
    task();
    ranks.GoOn(true);
  }
  catch (const RankError&)
  {
    throw;
  }
  catch (const std::bad_alloc&)
  {
    ranks.FailForMemory();
  }
  catch (const std::exception& error)
  {
    ranks.Fail(error.what());
  }
}

}

#endif

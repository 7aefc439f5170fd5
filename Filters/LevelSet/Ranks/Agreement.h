/**
 * Collective operations of ranks, which report failure and cancellation to all ranks.
 *
 * All ranks call the same operations in the same order. A rank that has failed calls Fail instead
 * of the next operation. That operation then throws RankError with the same message on all ranks,
 * so no rank waits for a failed rank. A rank whose process has ended cannot call Fail; MPI has to
 * detect the end of the process.
 */
#ifndef Agreement_h
#define Agreement_h

#include "ActiveLevelSetExport.h"
#include "Ranks/Communicator.h"
#include "Ranks/RankBytes.h"

#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace activesurface
{

/** Error that all ranks throw together, with the same message. */
class ACTIVELEVELSET_EXPORT RankError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/** Error if the lowest rank that failed has run out of memory. */
class ACTIVELEVELSET_EXPORT RankMemoryError : public RankError
{
public:
  using RankError::RankError;
};

/** Returns true for std::bad_alloc and RankMemoryError. */
ACTIVELEVELSET_EXPORT bool IsOfMemory(const std::exception& error);

class ACTIVELEVELSET_EXPORT Agreement
{
public:
  /** For a program of one process. */
  Agreement();
  /** Copies share the communicator. */
  explicit Agreement(std::shared_ptr<Communicator> ranks);

  int GetRank() const { return this->Ranks->GetRank(); }
  int GetSize() const { return this->Ranks->GetSize(); }
  bool IsAlone() const { return this->GetSize() < 2; }

  /** Collective. Returns the bytes of each rank, by rank. Throws RankError if a rank has failed. */
  std::vector<Bytes> Exchange(const Bytes& own) const;

  ///@{
  /** Collective. Sends bytes to each rank and returns the bytes that each rank has sent to this
   * rank, by rank. sizes: numbers of bytes from each rank; without `sizes` the ranks first
   * exchange these numbers. Throw RankError if a rank has failed. */
  std::vector<Bytes> Distribute(std::vector<Bytes> toEach) const;
  std::vector<Bytes> Distribute(
    std::vector<Bytes> toEach, const std::vector<std::size_t>& sizes) const;
  ///@}

  /** Collective. On rank 0, returns the bytes of each rank, by rank; on other ranks, returns
   * nothing. */
  std::vector<Bytes> GatherToFirst(Bytes own) const;

  ///@{
  /** Collective. ExchangeValue returns the value of each rank, by rank. ExchangeValues returns the
   * values of all ranks, concatenated by rank. */
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

  /** Collective. Returns true if `own` is true on all ranks. Throws RankError if a rank has failed.
   */
  bool GoOn(bool own) const;

  /** A rank that has failed calls Fail in place of the operation that the other ranks call. Throws
   * RankError on all ranks, with the message of the lowest rank that failed. The number of that
   * rank precedes the message, unless all ranks have failed with the same message, or that rank has
   * called FailForMemory. */
  [[noreturn]] void Fail(const std::string& sentence) const;
  /**
   * Fails because memory is exhausted. Throws RankMemoryError on all ranks, unless a lower rank has
   * failed for another reason.
   */
  [[noreturn]] void FailForMemory() const;

private:
  std::vector<std::int64_t> Begin(std::int64_t own) const;
  [[noreturn]] void ThrowTogether(const std::string& sentence) const;

  std::shared_ptr<Communicator> Ranks;
};

/** Runs a task on every rank. The task may call collective operations. A std::exception on one rank
 * becomes a RankError on all ranks. Ranks wait for each other at the end, so that a late error of a
 * rank still reaches all ranks. */
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

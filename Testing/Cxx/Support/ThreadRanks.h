/**
 * Ranks that are threads of one program: what ranks say to each other, tested without MPI.
 */
#ifndef ThreadRanks_h
#define ThreadRanks_h

#include "Agreement.h"
#include "Communicator.h"

#include <algorithm>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

namespace activesurface
{

/** Where they meet. A round that is not complete after a minute is an error. */
class MeetingPoint
{
public:
  explicit MeetingPoint(int size)
    : Brought(static_cast<std::size_t>(size))
  {
  }

  int GetSize() const { return static_cast<int>(this->Brought.size()); }

  std::vector<Bytes> Meet(int rank, const Bytes& own)
  {
    std::unique_lock<std::mutex> lock(this->Lock);
    this->Brought[static_cast<std::size_t>(rank)] = own;
    const int round = this->Round;
    if (++this->Arrived == this->GetSize())
    {
      this->Taken = this->Brought;
      this->Arrived = 0;
      ++this->Round;
      this->Complete.notify_all();
    }
    else if (!this->Complete.wait_for(
               lock, std::chrono::seconds(60), [&] { return this->Round != round; }))
    {
      throw std::logic_error("a rank waits for one that has gone");
    }
    return this->Taken;
  }

private:
  std::mutex Lock;
  std::condition_variable Complete;
  std::vector<Bytes> Brought;
  std::vector<Bytes> Taken;
  int Arrived = 0;
  int Round = 0;
};

class ThreadCommunicator : public Communicator
{
public:
  ThreadCommunicator(MeetingPoint& place, int rank)
    : Place(place)
    , Rank(rank)
  {
  }

  int GetRank() const override { return this->Rank; }
  int GetSize() const override { return this->Place.GetSize(); }

  std::int64_t Max(std::int64_t own) override
  {
    const std::vector<Bytes> all = this->Place.Meet(this->Rank, Bytes(1, static_cast<char>(own)));
    return std::max_element(all.begin(), all.end())->front();
  }

  std::vector<Bytes> AllGather(const Bytes& own) override
  {
    return this->Place.Meet(this->Rank, own);
  }

  std::vector<Bytes> Swap(
    const std::vector<Bytes>& toEach, const std::vector<std::size_t>& sizes) override
  {
    std::vector<Bytes> fromEach(toEach.size());
    for (std::size_t to = 0; to < toEach.size(); ++to)
    {
      const std::vector<Bytes> all = this->Place.Meet(this->Rank, toEach[to]);
      fromEach = static_cast<int>(to) == this->Rank ? all : fromEach;
    }
    for (std::size_t from = 0; from < sizes.size(); ++from)
    {
      if (fromEach[from].size() != sizes[from])
      {
        throw std::logic_error("a rank has sent more or less than was expected");
      }
    }
    return fromEach;
  }

private:
  MeetingPoint& Place;
  const int Rank;
};

/** Runs a program on so many ranks; what one throws is thrown, of the first one. */
inline void RunOnRanks(int size, const std::function<void(MeetingPoint& place, int rank)>& program)
{
  MeetingPoint place(size);
  std::vector<std::exception_ptr> errors(static_cast<std::size_t>(size));
  std::vector<std::thread> threads;
  for (int rank = 0; rank < size; ++rank)
  {
    threads.emplace_back(
      [&, rank]
      {
        try
        {
          program(place, rank);
        }
        catch (...)
        {
          errors[static_cast<std::size_t>(rank)] = std::current_exception();
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (const std::exception_ptr& error : errors)
  {
    if (error)
    {
      std::rethrow_exception(error);
    }
  }
}

inline void RunOnRanks(int size, const std::function<void(Agreement& ranks)>& program)
{
  RunOnRanks(size,
    [&program](MeetingPoint& place, int rank)
    {
      Agreement ranks(std::make_unique<ThreadCommunicator>(place, rank));
      program(ranks);
    });
}

}

#endif

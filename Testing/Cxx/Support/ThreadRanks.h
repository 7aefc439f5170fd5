/**
 * Ranks that are threads of one program: tests of the ranks' messages without MPI.
 */
#ifndef ThreadRanks_h
#define ThreadRanks_h

#include "Ranks/Agreement.h"
#include "Ranks/Communicator.h"
#include "Ranks/RankBytes.h"

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

/** Exchange of the ranks' bytes. A collective that is not complete after a minute is an error. */
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

  std::vector<std::int64_t> AllGather(std::int64_t own) override
  {
    std::vector<std::int64_t> numbers;
    for (const Bytes& ofRank : this->Place.Meet(this->Rank, ToBytes<std::int64_t>({ own })))
    {
      numbers.push_back(FromBytes<std::int64_t>(ofRank).front());
    }
    return numbers;
  }

  void AllGather(const Bytes& own, std::vector<Bytes>& all) override
  {
    Put(this->Place.Meet(this->Rank, own), all, -1);
  }

  void Swap(const std::vector<Bytes>& toEach, std::vector<Bytes>& fromEach) override
  {
    for (std::size_t to = 0; to < toEach.size(); ++to)
    {
      const std::vector<Bytes> all = this->Place.Meet(this->Rank, toEach[to]);
      if (static_cast<int>(to) == this->Rank)
      {
        Put(all, fromEach, this->Rank);
      }
    }
  }

private:
  static void Put(const std::vector<Bytes>& sent, std::vector<Bytes>& room, int except)
  {
    for (std::size_t from = 0; from < sent.size(); ++from)
    {
      if (static_cast<int>(from) == except)
      {
        continue;
      }
      if (sent[from].size() != room[from].size())
      {
        throw std::logic_error("a rank has sent more or less than was expected");
      }
      room[from] = sent[from];
    }
  }

  MeetingPoint& Place;
  const int Rank;
};

/** Runs a program on `size` ranks, as threads; rethrows the exception of the lowest failed rank. */
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

#include "Ranks/ControllerCommunicator.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace activesurface
{

namespace
{

constexpr std::size_t MostAtOnce = std::size_t(1) << 30; // MPI counts in int
// Gathered in pairs: without a copy of all, and MPI counts what all send at once in int, too.
constexpr std::size_t LongMessage = std::size_t(1) << 16;

constexpr int TagOfSwaps = 18091; // MPI grants 32767 at most

int RoundUpToPowerOfTwo(int number)
{
  int power = 1;
  while (power < number)
  {
    power *= 2;
  }
  return power;
}

void Check(int isDone)
{
  if (!isDone)
  {
    throw std::runtime_error("The ranks cannot reach each other: the controller has failed.");
  }
}

std::vector<std::size_t> GatherLengths(vtkMultiProcessController* controller, std::size_t own)
{
  const auto length = static_cast<long long>(own);
  std::vector<long long> lengths(static_cast<std::size_t>(controller->GetNumberOfProcesses()));
  Check(controller->AllGather(&length, lengths.data(), 1));
  return { lengths.begin(), lengths.end() };
}

}

ControllerCommunicator::ControllerCommunicator(vtkMultiProcessController* controller)
  : Controller(controller)
{
}

ControllerCommunicator::~ControllerCommunicator() = default;

int ControllerCommunicator::GetRank() const
{
  return this->Controller->GetLocalProcessId();
}

int ControllerCommunicator::GetSize() const
{
  return this->Controller->GetNumberOfProcesses();
}

std::int64_t ControllerCommunicator::Max(std::int64_t own)
{
  const long long mine = own;
  long long largest = mine;
  Check(this->Controller->AllReduce(&mine, &largest, 1, vtkCommunicator::MAX_OP));
  return largest;
}

std::vector<Bytes> ControllerCommunicator::AllGather(const Bytes& own)
{
  const std::vector<std::size_t> lengths = GatherLengths(this->Controller, own.size());
  if (*std::max_element(lengths.begin(), lengths.end()) > LongMessage)
  {
    return this->SwapInPairs([&own](int) -> const Bytes& { return own; }, lengths);
  }
  std::vector<Bytes> all(lengths.size());
  std::vector<vtkIdType> counts(lengths.begin(), lengths.end());
  std::vector<vtkIdType> offsets(1, 0);
  std::partial_sum(counts.begin(), counts.end(), std::back_inserter(offsets));
  Bytes received(static_cast<std::size_t>(offsets.back()) + 1); // not null
  Check(this->Controller->AllGatherV(own.data(), received.data(),
    static_cast<vtkIdType>(own.size()), counts.data(), offsets.data()));
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    all[rank].assign(received.data() + offsets[rank], received.data() + offsets[rank + 1]);
  }
  return all;
}

std::vector<Bytes> ControllerCommunicator::Swap(
  const std::vector<Bytes>& toEach, const std::vector<std::size_t>& sizes)
{
  return this->SwapInPairs(
    [&toEach](int rank) -> const Bytes& { return toEach[static_cast<std::size_t>(rank)]; }, sizes);
}

// In each round a rank meets one other; of the two the lower one speaks first.
template <class GetOwn>
std::vector<Bytes> ControllerCommunicator::SwapInPairs(
  GetOwn&& getOwn, const std::vector<std::size_t>& sizes)
{
  const int rank = this->GetRank(), size = this->GetSize();
  std::vector<Bytes> fromEach(sizes.size());
  fromEach[static_cast<std::size_t>(rank)] = getOwn(rank);
  for (int round = 1; round < RoundUpToPowerOfTwo(size); ++round)
  {
    const int other = rank ^ round;
    if (other >= size)
    {
      continue;
    }
    Bytes& from = fromEach[static_cast<std::size_t>(other)];
    from.resize(sizes[static_cast<std::size_t>(other)]);
    if (rank < other)
    {
      this->Send(getOwn(other), other);
      this->Receive(from, other);
    }
    else
    {
      this->Receive(from, other);
      this->Send(getOwn(other), other);
    }
  }
  return fromEach;
}

void ControllerCommunicator::Send(const Bytes& bytes, int rank)
{
  for (std::size_t done = 0; done < bytes.size(); done += MostAtOnce)
  {
    const std::size_t count = std::min<std::size_t>(bytes.size() - done, MostAtOnce);
    Check(
      this->Controller->Send(bytes.data() + done, static_cast<vtkIdType>(count), rank, TagOfSwaps));
  }
}

void ControllerCommunicator::Receive(Bytes& bytes, int rank)
{
  for (std::size_t done = 0; done < bytes.size(); done += MostAtOnce)
  {
    const std::size_t count = std::min<std::size_t>(bytes.size() - done, MostAtOnce);
    Check(this->Controller->Receive(
      bytes.data() + done, static_cast<vtkIdType>(count), rank, TagOfSwaps));
  }
}

Agreement MakeAgreement(vtkMultiProcessController* controller)
{
  return controller && controller->GetNumberOfProcesses() > 1
    ? Agreement(std::make_shared<ControllerCommunicator>(controller))
    : Agreement();
}

}

#include "Ranks/ControllerCommunicator.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

namespace activesurface
{

namespace
{

constexpr std::size_t MostAtOnce = std::size_t(1) << 30; // bytes; MPI counts in int
// If a message is longer than this [bytes], AllGather exchanges all messages by pairs of ranks. No
// rank then needs a second copy of all bytes, and the total number of bytes may exceed the range of
// int, MPI's type of counts.
constexpr vtkIdType LongMessage = 1 << 16;

constexpr int TagOfSwaps = 18091; // MPI guarantees tags only up to 32767

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
    throw std::runtime_error(
      "The communication between the ranks failed: the Controller reports an error; "
      "see the messages of MPI, and restart all ranks.");
  }
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

std::vector<std::int64_t> ControllerCommunicator::AllGather(std::int64_t own)
{
  const long long number = own;
  std::vector<long long> numbers(static_cast<std::size_t>(this->GetSize()));
  Check(this->Controller->AllGather(&number, numbers.data(), 1));
  return { numbers.begin(), numbers.end() };
}

void ControllerCommunicator::AllGather(const Bytes& own, std::vector<Bytes>& all)
{
  std::vector<vtkIdType> counts, offsets(1, 0);
  for (const Bytes& ofRank : all)
  {
    counts.push_back(static_cast<vtkIdType>(ofRank.size()));
    offsets.push_back(offsets.back() + counts.back());
  }
  if (*std::max_element(counts.begin(), counts.end()) > LongMessage)
  {
    all[static_cast<std::size_t>(this->GetRank())] = own;
    this->SwapInPairs([&own](int) -> const Bytes& { return own; }, all);
    return;
  }
  Bytes received(static_cast<std::size_t>(offsets.back()) + 1); // so that data() is not null
  Check(this->Controller->AllGatherV(own.data(), received.data(),
    static_cast<vtkIdType>(own.size()), counts.data(), offsets.data()));
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    std::copy(
      received.data() + offsets[rank], received.data() + offsets[rank + 1], all[rank].begin());
  }
}

void ControllerCommunicator::Swap(const std::vector<Bytes>& toEach, std::vector<Bytes>& fromEach)
{
  this->SwapInPairs([&toEach](int rank) -> const Bytes&
    { return toEach[static_cast<std::size_t>(rank)]; },
    fromEach);
}

// In each pass, a rank exchanges bytes with at most one other rank. The lower rank sends first.
template <class GetOwn>
void ControllerCommunicator::SwapInPairs(GetOwn&& getOwn, std::vector<Bytes>& fromEach)
{
  const int rank = this->GetRank(), size = this->GetSize();
  for (int round = 1; round < RoundUpToPowerOfTwo(size); ++round)
  {
    const int other = rank ^ round;
    if (other >= size)
    {
      continue;
    }
    Bytes& from = fromEach[static_cast<std::size_t>(other)];
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

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

// MPI counts in int: what all ranks send at once is to be less than 2^31 bytes.
constexpr std::int64_t MostAtOnce = std::int64_t(1) << 30;

void Check(int isDone)
{
  if (!isDone)
  {
    throw std::runtime_error("The ranks cannot reach each other: the controller has failed.");
  }
}

std::vector<std::int64_t> GatherLengths(vtkMultiProcessController* controller, std::size_t own)
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

// In as many rounds as the longest needs.
std::vector<Bytes> ControllerCommunicator::AllGather(const Bytes& own)
{
  const std::vector<std::int64_t> lengths = GatherLengths(this->Controller, own.size());
  const std::int64_t longest = *std::max_element(lengths.begin(), lengths.end());
  const std::size_t size = lengths.size();
  const std::int64_t atOnce = MostAtOnce / static_cast<std::int64_t>(size);
  std::vector<Bytes> all(size);
  Bytes received;
  std::vector<vtkIdType> counts(size), offsets(size);
  for (std::int64_t done = 0; done < longest; done += atOnce)
  {
    vtkIdType sum = 0;
    for (std::size_t rank = 0; rank < size; ++rank)
    {
      counts[rank] = std::clamp<std::int64_t>(lengths[rank] - done, 0, atOnce);
      offsets[rank] = sum;
      sum += counts[rank];
    }
    received.resize(static_cast<std::size_t>(sum));
    const vtkIdType count = counts[static_cast<std::size_t>(this->GetRank())];
    const char* sent = own.data() + (count > 0 ? done : 0);
    Check(
      this->Controller->AllGatherV(sent, received.data(), count, counts.data(), offsets.data()));
    for (std::size_t rank = 0; rank < size; ++rank)
    {
      const char* first = received.data() + offsets[rank];
      all[rank].insert(all[rank].end(), first, first + counts[rank]);
    }
  }
  return all;
}

Agreement MakeAgreement(vtkMultiProcessController* controller)
{
  return controller && controller->GetNumberOfProcesses() > 1
    ? Agreement(std::make_unique<ControllerCommunicator>(controller))
    : Agreement();
}

}

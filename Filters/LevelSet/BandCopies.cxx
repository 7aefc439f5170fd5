// Copies of a band: another band, or bytes.

#include "BandState.h"
#include "NarrowBand.h"
#include "State/BoxCut.h"
#include "State/PackedBand.h"
#include "State/SavedTree.h"

#include <array>
#include <cstring>
#include <memory>
#include <string>

namespace activesurface
{

namespace
{

/** Order of the StateNumbers in packed bytes. */
using PackedNumbers = std::array<double, 7>;

}

void NarrowBand::CopyNumbersTo(NarrowBand& copy) const
{
  BandState& members = *copy.State;
  members.SetNumbers(this->State->GetNumbers());
  members.Threads = this->State->Threads;
  members.Maximum = this->State->Maximum;
  members.Work = this->State->Work;
  members.SetPart(this->State->Part);
}

std::unique_ptr<NarrowBand> NarrowBand::Clone() const
{
  auto copy = std::make_unique<NarrowBand>(this->State->VoxelSize);
  this->CopyNumbersTo(*copy);
  copy->Run(
    [&] {
      copy->State->AdoptTree(std::make_shared<openvdb::FloatTree>(this->State->Potential->tree()));
    });
  return copy;
}

std::unique_ptr<NarrowBand> NarrowBand::MakePartWithin(const Walls& walls) const
{
  auto part = std::make_unique<NarrowBand>(this->State->VoxelSize);
  this->CopyNumbersTo(*part);
  BandState& members = *part->State;
  members.SetPart(nullptr); // periodic boxes are not partitioned
  members.HasGhosts = false;
  part->Run(
    [&] { members.Restore(CutAtWalls(this->State->Potential->tree(), walls, members.VoxelSize)); });
  return part;
}

void NarrowBand::AddGhosts()
{
  this->Run([&] { this->State->AddGhosts(); });
}

bool NarrowBand::HasGhosts() const
{
  return this->State->HasGhosts;
}

std::string NarrowBand::Pack() const
{
  const StateNumbers n = this->State->GetNumbers();
  const PackedNumbers packed = { n.VoxelSize, n.Time, n.StartArea, n.StartVolume, n.BoxSize,
    n.Paper ? 1.0 : 0.0, n.HasGhosts ? 1.0 : 0.0 };
  std::string bytes(reinterpret_cast<const char*>(packed.data()), sizeof packed);
  const BandState& members = *this->State;
  if (members.Part)
  {
    PackPart(members.Leaves, n.HasGhosts, members.Potential->tree(), bytes);
  }
  else
  {
    PackBand(members.Leaves, n.HasGhosts, bytes);
  }
  return bytes;
}

std::unique_ptr<NarrowBand> NarrowBand::Unpack(
  const std::string& bytes, const std::shared_ptr<const BandPart>& part)
{
  PackedNumbers packed;
  if (bytes.size() < sizeof packed)
  {
    RefuseState();
  }
  std::memcpy(packed.data(), bytes.data(), sizeof packed);
  const StateNumbers numbers = { packed[0], packed[1], packed[2], packed[3], packed[4],
    packed[5] != 0.0, packed[6] != 0.0, 0.f };
  auto band = std::make_unique<NarrowBand>(numbers.VoxelSize);
  BandState& members = *band->State;
  members.SetNumbers(numbers);
  members.SetPart(part);
  const auto unpack = [&, rest = bytes.substr(sizeof packed)]
  {
    return part ? UnpackPart(rest, members.GetBackground())
                : UnpackBand({ rest }, members.GetBackground());
  };
  band->Run([&] { members.Restore(unpack()); });
  return band;
}

}

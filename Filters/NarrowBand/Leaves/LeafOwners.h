/**
 * Which rank computes which leaves while ranks advance a band together.
 *
 * Every rank has the table of all leaves. A pass computes those of its own rank, from them and the
 * leaves beside them; LeafExchange.h then tells the other ranks what they need to know.
 */
#ifndef LeafOwners_h
#define LeafOwners_h

#include "Agreement.h"
#include "Leaves/LeafSlots.h"
#include "OpenVDB.h"

#include <cstdint>
#include <vector>

namespace activesurface
{

class LeafTable;

/** Numbers of leaves, ascending, for each rank. */
struct LeafBorders
{
  std::vector<std::vector<std::int32_t>> Own;    //< own leaves beside that rank's
  std::vector<std::vector<std::int32_t>> Others; //< that rank's leaves beside the own ones
};

class LeafOwners
{
public:
  explicit LeafOwners(Agreement& ranks)
    : Ranks(ranks)
    , Rank(ranks.GetRank())
    , Size(ranks.GetSize())
  {
  }
  LeafOwners(const LeafOwners&) = delete;
  void operator=(const LeafOwners&) = delete;
  virtual ~LeafOwners() = default;

  Agreement& GetAgreement() { return this->Ranks; }
  int GetRank() const { return this->Rank; }
  int GetSize() const { return this->Size; }

  int GetOwner(std::size_t leaf) const { return this->Owners[leaf]; }
  bool IsOwn(std::size_t leaf) const { return this->Owners[leaf] == this->Rank; }
  /** Of a leaf that may not be there yet. */
  virtual int FindOwner(const openvdb::Coord& origin) const = 0;

  const LeafBorders& GetBorders() const { return this->Borders; }
  /** Of the own leaves and those beside them: the leaves that passes of this rank read. */
  const LeafSlots& GetSlots() const { return this->Slots; }

  ///@{
  /** Called by the table, on all ranks, when leaves have been added, or all have other numbers. */
  virtual void AddLeaves(LeafTable& table) = 0;
  virtual void Renumber(LeafTable& table) = 0;
  ///@}

  ///@{
  /** Whether each rank knows the values of all leaves, as at the beginning. */
  bool AreValuesWhole() const { return this->ValuesAreWhole; }
  void SetValuesAreWhole(bool areWhole) { this->ValuesAreWhole = areWhole; }
  ///@}

protected:
  std::vector<int> Owners; //< by leaf
  LeafBorders Borders;
  LeafSlots Slots;

private:
  Agreement& Ranks;
  const int Rank;
  const int Size;
  bool ValuesAreWhole = true;
};

}

#endif

#include "Leaves/ActiveSet.h"

#include <numeric>
#include <utility>

namespace activesurface
{

void ActiveSet::ChooseAll(const LeafTable& table)
{
  this->Active.resize(table.Size());
  std::iota(this->Active.begin(), this->Active.end(), 0);
  this->Affected = this->Active;
}

void ActiveSet::Choose(const LeafTable& table, LeafList active)
{
  this->Active = std::move(active);
  this->Affected = table.FindAround(this->Active);
}

void ActiveSet::AddCreated(const LeafList& created)
{
  this->Affected.insert(this->Affected.end(), created.begin(), created.end());
}

}

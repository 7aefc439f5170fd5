#include "Leaves/WholeBand.h"

#include "Leaves/LeafExchange.h"

namespace activesurface
{

namespace
{

/** Where memory ended on one of them in the middle of a change, their tables differ. */
void CheckTables(const LeafTable& table)
{
  const auto size = static_cast<std::int64_t>(table.Size());
  Agreement& ranks = table.GetRanks()->GetAgreement();
  const std::int64_t sum = SumOverRanks<1>(table, { size })[0];
  RunTogether(ranks,
    [&]
    {
      if (sum != size * ranks.GetSize())
      {
        throw std::runtime_error("The ranks have lost each other's skin, as one of them could not "
                                 "go on; ask for an earlier time, or start anew.");
      }
    });
}

void MakeBandWhole(LeafTable& table)
{
  MakeValuesWhole(table);
  TellAll(table,
    [&table](std::size_t i, auto& pass)
    {
      BandLeaf& leaf = table[i];
      pass(&leaf.Inside, 1);
      pass(&leaf.Active, 1);
      pass(&leaf.Updated, 1);
      pass(&leaf.HoldsStaleValue, 1);
      pass(leaf.Edge.data(), leaf.Edge.size());
      pass(leaf.CrossingsBefore.data(), leaf.CrossingsBefore.size());
    });
}

}

void MakeValuesWhole(LeafTable& table)
{
  LeafOwners* ranks = table.GetRanks();
  if (ranks && IsSoOnAny(table, !ranks->AreValuesWhole()))
  {
    TellAll(table,
      [&table](std::size_t i, auto& pass)
      {
        pass(table[i].Value, 512);
        pass(table[i].UpToLayer.data(), table[i].UpToLayer.size());
      });
    ranks->SetValuesAreWhole(true);
  }
}

void LeaveRanks(LeafTable& table, PotentialTree& tree)
{
  if (!table.GetRanks())
  {
    return;
  }
  try
  {
    CheckTables(table);
    MakeBandWhole(table);
  }
  catch (...)
  {
    table.SetRanks(nullptr);
    tree.clear();
    table.Rebuild(tree);
    throw;
  }
  table.SetRanks(nullptr);
}

}

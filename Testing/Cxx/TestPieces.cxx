// The outputs shared out in pieces, as to the ranks of a parallel program: nothing twice.

#include "Check.h"
#include "PipelineTools.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

using namespace activesurface;
using SDDP = vtkStreamingDemandDrivenPipeline;

namespace
{

void UpdatePieceAt(
  vtkActiveImplicitSurface* filter, int port, int piece, double time, int pieces = 2)
{
  filter->UpdateInformation();
  vtkInformation* out = filter->GetOutputInformation(port);
  out->Set(SDDP::UPDATE_PIECE_NUMBER(), piece);
  out->Set(SDDP::UPDATE_NUMBER_OF_PIECES(), pieces);
  out->Set(SDDP::UPDATE_TIME_STEP(), time);
  filter->Update(port);
}

}

void TheFirstPieceIsAllOfTheSkin(Check& check)
{
  auto filter = MakeShrinkingBall();
  const std::string expected = GetBytesAt(filter, 0.3);
  auto first = MakeShrinkingBall();
  UpdatePieceAt(first, 0, 0, 0.3);
  check.True(GetBytes(first) == expected, "the first piece");
  check.Equal(first->GetHistory()->GetNumberOfRows(), 4, "rows of its history");
}

void OtherPiecesAreEmptyAndCostNothing(Check& check)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  Messages messages(filter);
  UpdatePieceAt(filter, 0, 1, 3.0);
  check.Equal(filter->GetOutput()->GetNumberOfPoints(), 0, "points of the second piece");
  check.Equal(filter->GetSubsteps(), 0, "substeps");
  UpdatePieceAt(filter, 2, 1, 3.0);
  check.Equal(filter->GetHistory()->GetNumberOfRows(), 0, "rows of the second piece");
  check.Equal(filter->GetSubsteps(), 0, "substeps, with the history");
  check.Equal(messages.Errors.size(), std::size_t(0), "errors");
  UpdatePieceAt(filter, 0, 0, 3.0);
  auto other = MakeSkinOver(MakeMovingBall());
  check.True(GetBytes(filter) == GetBytesAt(other, 3.0), "then the first piece, as ever");
}

// Particles have no bounds before they are read, and nobody was connected who needed them.
void PiecesOfAnImageWithoutABoxAreParts(Check& check)
{
  auto whole = MakeSkinOver(MakeMovingBall());
  whole->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
  UpdatePieceAt(whole, 1, 0, 3.0, 1);
  vtkIdType nodes = 0;
  for (int piece = 0; piece < 2; ++piece)
  {
    auto filter = MakeSkinOver(MakeMovingBall());
    filter->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
    UpdatePieceAt(filter, 1, piece, 3.0);
    check.Less(filter->GetPotential()->GetNumberOfPoints(),
      0.6 * whole->GetPotential()->GetNumberOfPoints(), "nodes of half the image");
    nodes += filter->GetPotential()->GetNumberOfPoints();
  }
  check.True(nodes >= whole->GetPotential()->GetNumberOfPoints(), "nodes of both halves");
}

void ThereMayBeMorePiecesThanNodes(Check& check)
{
  auto filter = MakeSkinOver(MakeMovingBall());
  filter->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
  Messages messages(filter);
  UpdatePieceAt(filter, 1, 9999999, 3.0, 10000000);
  check.True(filter->GetPotential()->GetNumberOfPoints() <= 8, "nodes of the last piece");
  check.Equal(messages.Errors.size(), std::size_t(0), "errors");
}

// Pieces of an image share a layer of nodes, or not; every node is in one at least, with its value.
void PiecesOfTheImageMakeUpTheWhole(Check& check)
{
  auto filter = MakeShrinkingBall();
  filter->UpdateInformation();
  filter->GetOutputInformation(1)->Set(SDDP::UPDATE_TIME_STEP(), 0.3);
  filter->Update(1);
  vtkImageData* whole = filter->GetPotential();
  std::vector<int> found(static_cast<std::size_t>(whole->GetNumberOfPoints()), 0);
  int wrong = 0;
  for (int piece = 0; piece < 2; ++piece)
  {
    auto rank = MakeShrinkingBall();
    UpdatePieceAt(rank, 0, piece, 0.3);
    UpdatePieceAt(rank, 1, piece, 0.3);
    check.Equal(rank->GetHistory()->GetNumberOfRows(), piece == 0 ? 4 : 0, "rows beside a piece");
    vtkImageData* part = rank->GetPotential();
    check.Less(part->GetNumberOfPoints(), whole->GetNumberOfPoints(), "nodes of a piece");
    for (vtkIdType i = 0; i < part->GetNumberOfPoints(); ++i)
    {
      const vtkIdType node = whole->FindPoint(part->GetPoint(i));
      ++found[static_cast<std::size_t>(node)];
      wrong += part->GetPointData()->GetScalars()->GetTuple1(i) !=
        whole->GetPointData()->GetScalars()->GetTuple1(node);
    }
  }
  check.Equal(std::count(found.begin(), found.end(), 0), 0, "nodes in no piece");
  check.Equal(wrong, 0, "nodes of another value");
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    {
      { "TheFirstPieceIsAllOfTheSkin", TheFirstPieceIsAllOfTheSkin },
      { "OtherPiecesAreEmptyAndCostNothing", OtherPiecesAreEmptyAndCostNothing },
      { "PiecesOfAnImageWithoutABoxAreParts", PiecesOfAnImageWithoutABoxAreParts },
      { "ThereMayBeMorePiecesThanNodes", ThereMayBeMorePiecesThanNodes },
      { "PiecesOfTheImageMakeUpTheWhole", PiecesOfTheImageMakeUpTheWhole },
    });
}

// Outputs divided into pieces, as for the ranks of a parallel program.

#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

using namespace activesurface;

namespace TestPieces
{

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

TEST(TestPieces, TheFirstPieceIsAllOfTheSkin)
{
  auto filter = MakeShrinkingBall();
  const std::string expected = GetBytesAt(filter, 0.3);
  auto first = MakeShrinkingBall();
  UpdatePieceAt(first, 0, 0, 0.3);
  EXPECT_TRUE(AreSameSkins(GetBytes(first), expected)) << "the first piece";
  EXPECT_EQ(first->GetHistory()->GetNumberOfRows(), 4) << "rows of its history";
}

TEST(TestPieces, OtherPiecesAreEmptyAndCostNothing)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  MessageCapture messages(filter);
  UpdatePieceAt(filter, 0, 1, 3.0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points of the second piece";
  EXPECT_EQ(filter->GetSubsteps(), 0) << "substeps";
  UpdatePieceAt(filter, 2, 1, 3.0);
  EXPECT_EQ(filter->GetHistory()->GetNumberOfRows(), 0) << "rows of the second piece";
  EXPECT_EQ(filter->GetSubsteps(), 0) << "substeps, with the history";
  EXPECT_EQ(messages.Errors.size(), 0u) << "errors";
  UpdatePieceAt(filter, 0, 0, 3.0);
  auto other = MakeSkinOver(MakeMovingBall());
  EXPECT_TRUE(AreSameSkins(GetBytes(filter), GetBytesAt(other, 3.0)))
    << "then the first piece, as ever";
}

// After the first update the input is at a step, and VTK would assign the time of that step to the
// piece.
TEST(TestPieces, OtherPiecesHaveTheTimeOfTheFirst)
{
  auto filter = MakeSkinOver(MakeMovingBall());
  UpdatePieceAt(filter, 0, 0, 1.0);
  for (const auto& [asked, told] :
    { std::pair(2.5, 2.5), std::pair(3.0, 3.0), std::pair(-1.0, 0.0), std::pair(99.0, 4.0) })
  {
    for (const int port : { 0, 2 })
    {
      UpdatePieceAt(filter, port, 1, asked);
      vtkInformation* data = filter->GetOutputDataObject(port)->GetInformation();
      EXPECT_EQ(data->Get(vtkDataObject::DATA_TIME_STEP()), told) << "of port " << port;
    }
  }
}

// Without ModelBounds the extent of the image is unknown until the particles have been read.
TEST(TestPieces, PiecesOfAnImageWithoutABoxAreParts)
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
    EXPECT_LT(
      filter->GetPotential()->GetNumberOfPoints(), 0.6 * whole->GetPotential()->GetNumberOfPoints())
      << "nodes of half the image";
    nodes += filter->GetPotential()->GetNumberOfPoints();
  }
  EXPECT_TRUE(nodes >= whole->GetPotential()->GetNumberOfPoints()) << "nodes of both halves";
}

TEST(TestPieces, ThereMayBeMorePiecesThanNodes)
{
  auto filter = MakeSkinOver(MakeMovingBall());
  filter->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
  MessageCapture messages(filter);
  UpdatePieceAt(filter, 1, 9999999, 3.0, 10000000);
  EXPECT_TRUE(filter->GetPotential()->GetNumberOfPoints() <= 8) << "nodes of the last piece";
  EXPECT_EQ(messages.Errors.size(), 0u) << "errors";
}

// Pieces of an image may share a layer of nodes.
TEST(TestPieces, PiecesOfTheImageMakeUpTheWhole)
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
    EXPECT_EQ(rank->GetHistory()->GetNumberOfRows(), piece == 0 ? 4 : 0) << "rows beside a piece";
    vtkImageData* part = rank->GetPotential();
    EXPECT_LT(part->GetNumberOfPoints(), whole->GetNumberOfPoints()) << "nodes of a piece";
    for (vtkIdType i = 0; i < part->GetNumberOfPoints(); ++i)
    {
      const vtkIdType node = whole->FindPoint(part->GetPoint(i));
      ++found[static_cast<std::size_t>(node)];
      wrong += part->GetPointData()->GetScalars()->GetTuple1(i) !=
        whole->GetPointData()->GetScalars()->GetTuple1(node);
    }
  }
  EXPECT_EQ(std::count(found.begin(), found.end(), 0), 0) << "nodes in no piece";
  EXPECT_EQ(wrong, 0) << "nodes of another value";
}

}

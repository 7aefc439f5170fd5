// Pieces of an input, put together on each rank.

#include "Base/OpenVDB.h"
#include "Input/AttachedGrid.h"
#include "Ranks/PieceGather.h"
#include "Support/ThreadRanks.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <limits>

using namespace activesurface;

namespace TestInputPiece
{

namespace
{

vtkSmartPointer<vtkPolyData> MakeRow(int first, int count)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("id");
  vtkNew<vtkStringArray> names;
  names->SetName("name");
  vtkNew<vtkDoubleArray> heat;
  heat->SetName("heat");
  for (int i = first; i < first + count; ++i)
  {
    points->InsertNextPoint(0.1 * i, 0.0, 0.0);
    ids->InsertNextValue((vtkIdType(1) << 40) + i);
    names->InsertNextValue("point " + std::to_string(i));
    heat->InsertNextValue(i == 2 ? std::numeric_limits<double>::quiet_NaN() : 1.0 / (i + 3));
  }
  auto row = vtkSmartPointer<vtkPolyData>::New();
  row->SetPoints(points);
  row->GetPointData()->AddArray(ids);
  row->GetPointData()->AddArray(names);
  row->GetPointData()->SetScalars(heat);
  return row;
}

const PieceArrays AllArrays{ true, {} };

vtkSmartPointer<vtkImageData> MakeSlices(int first, int last)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(-1, 3, 0, 2, first, last);
  image->SetSpacing(0.5, 0.5, 0.5);
  vtkNew<vtkFloatArray> values;
  values->SetName("value");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    values->InsertNextValue(static_cast<float>(x[0] + 10.0 * x[1] + 100.0 * x[2]));
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

// GetTuple1 and GetPoint(i) write to a buffer of the data, and the ranks are threads that share the
// expected data.
double Scalar(vtkDataSet* data, vtkIdType i)
{
  return data->GetPointData()->GetScalars()->GetComponent(i, 0);
}

double X(vtkDataSet* data, vtkIdType i)
{
  double x[3];
  data->GetPoint(i, x);
  return x[0];
}

// Gathers the pieces that `make` returns, and calls `check` with the whole on each rank.
void Gather(int size, const std::function<InputPiece(int rank)>& make,
  const std::function<void(vtkDataSet* whole)>& check)
{
  RunOnRanks(
    size, [&](Agreement& ranks) { check(GatherWhole(ranks, make(ranks.GetRank()), "The input")); });
}

}

TEST(TestInputPiece, ParticlesComeInTheOrderOfTheRanksAndKeepTheirBits)
{
  const auto expected = MakeRow(0, 7);
  Gather(
    3, [](int rank) { return MakeParticlePiece(MakeRow(rank * 2, rank == 2 ? 3 : 2), AllArrays); },
    [&](vtkDataSet* whole)
    {
      ASSERT_EQ(whole->GetNumberOfPoints(), 7);
      ASSERT_EQ(whole->GetPointData()->GetNumberOfArrays(), 3);
      auto ids = vtkIdTypeArray::SafeDownCast(whole->GetPointData()->GetArray("id"));
      auto names = vtkStringArray::SafeDownCast(whole->GetPointData()->GetAbstractArray("name"));
      ASSERT_TRUE(ids && names && whole->GetPointData()->GetScalars())
        << "types and active scalars are kept";
      for (vtkIdType i = 0; i < 7; ++i)
      {
        EXPECT_EQ(X(whole, i), X(expected, i));
        EXPECT_EQ(ids->GetValue(i), (vtkIdType(1) << 40) + i);
        EXPECT_EQ(names->GetValue(i), "point " + std::to_string(i));
        const double value = Scalar(expected, i);
        EXPECT_TRUE(i == 2 ? std::isnan(Scalar(whole, i)) : Scalar(whole, i) == value);
      }
    });
}

TEST(TestInputPiece, OnlyChosenArraysAreSent)
{
  Gather(
    2,
    [](int)
    {
      const auto row = MakeRow(0, 3);
      return MakeParticlePiece(
        row, { false, { row->GetPointData()->GetAbstractArray("heat"), nullptr } });
    },
    [](vtkDataSet* whole)
    {
      EXPECT_EQ(whole->GetPointData()->GetNumberOfArrays(), 1);
      EXPECT_TRUE(whole->GetPointData()->HasArray("heat"));
    });
}

TEST(TestInputPiece, DuplicatesOfOtherRanksAreLeftOut)
{
  Gather(
    2,
    [](int rank)
    {
      const auto row = MakeRow(3 * rank, 4); // the fourth of rank 0 is the first of rank 1
      vtkNew<vtkUnsignedCharArray> ghosts;
      ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
      for (int i = 0; i < 4; ++i)
      {
        ghosts->InsertNextValue(rank == 0 && i == 3
            ? static_cast<unsigned char>(vtkDataSetAttributes::DUPLICATEPOINT)
            : static_cast<unsigned char>(0));
      }
      row->GetPointData()->AddArray(ghosts);
      return MakeParticlePiece(row, AllArrays);
    },
    [](vtkDataSet* whole)
    {
      ASSERT_EQ(whole->GetNumberOfPoints(), 7);
      auto ids = vtkIdTypeArray::SafeDownCast(whole->GetPointData()->GetArray("id"));
      for (vtkIdType i = 0; i < 7; ++i)
      {
        EXPECT_EQ(ids->GetValue(i), (vtkIdType(1) << 40) + i);
      }
    });
}

TEST(TestInputPiece, ARankWithoutAnythingHasNoSay)
{
  Gather(
    3,
    [](int rank) { return rank == 1 ? MakeParticlePiece(MakeRow(0, 2), AllArrays) : InputPiece(); },
    [](vtkDataSet* whole) { EXPECT_EQ(whole->GetPointData()->GetNumberOfArrays(), 3); });
  Gather(
    2, [](int) { return InputPiece(); },
    [](vtkDataSet* whole) { EXPECT_EQ(whole->GetNumberOfPoints(), 0); });
}

TEST(TestInputPiece, ArraysThatARankDoesNotHaveAreLeftOut)
{
  Gather(
    2,
    [](int rank)
    {
      const auto row = MakeRow(0, 2);
      if (rank == 1)
      {
        row->GetPointData()->RemoveArray("heat");
      }
      return MakeParticlePiece(row, AllArrays);
    },
    [](vtkDataSet* whole) { EXPECT_EQ(whole->GetPointData()->GetNumberOfArrays(), 2); });
}

TEST(TestInputPiece, AnArrayOfTwoTypesIsRefused)
{
  const auto make = [](int rank)
  {
    const auto row = MakeRow(0, 2);
    vtkNew<vtkFloatArray> single;
    single->SetName("heat");
    single->SetNumberOfTuples(2);
    if (rank == 1)
    {
      row->GetPointData()->AddArray(single);
    }
    return MakeParticlePiece(row, AllArrays);
  };
  EXPECT_THROW(Gather(2, make, [](vtkDataSet*) {}), std::invalid_argument);
}

TEST(TestInputPiece, TwoKindsAreRefused)
{
  const auto make = [](int rank)
  {
    const auto image = MakeSlices(0, 1);
    return rank == 0 ? MakeParticlePiece(MakeRow(0, 2), AllArrays)
                     : MakeImagePiece(image, image->GetPointData()->GetScalars());
  };
  EXPECT_THROW(Gather(2, make, [](vtkDataSet*) {}), std::invalid_argument);
}

TEST(TestInputPiece, CellsKeepTheirCornersAndLoseTheirGhosts)
{
  Gather(
    2,
    [](int rank)
    {
      const auto row = MakeRow(4 * rank, 4);
      vtkNew<vtkCellArray> polys;
      vtkNew<vtkUnsignedCharArray> ghosts;
      ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
      for (vtkIdType i = 0; i < 2; ++i)
      {
        const vtkIdType corners[3] = { i, i + 1, i + 2 };
        polys->InsertNextCell(3, corners);
        ghosts->InsertNextValue(i == 1 && rank == 1
            ? static_cast<unsigned char>(vtkDataSetAttributes::DUPLICATECELL)
            : static_cast<unsigned char>(0));
      }
      row->SetPolys(polys);
      row->GetCellData()->AddArray(ghosts);
      return MakeCellPiece(row, {});
    },
    [](vtkDataSet* whole)
    {
      ASSERT_EQ(whole->GetNumberOfCells(), 3);
      vtkNew<vtkIdList> corners;
      whole->GetCellPoints(2, corners);
      EXPECT_EQ(X(whole, corners->GetId(0)), 0.1f * 4);
    });
}

TEST(TestInputPiece, SlicesMakeUpAnImage)
{
  const auto expected = MakeSlices(0, 5);
  Gather(
    3,
    [](int rank)
    {
      const auto image = MakeSlices(2 * rank, std::min(2 * rank + 2, 5));
      return MakeImagePiece(image, image->GetPointData()->GetScalars());
    },
    [&](vtkDataSet* whole)
    {
      ASSERT_EQ(whole->GetNumberOfPoints(), expected->GetNumberOfPoints());
      ASSERT_TRUE(whole->GetPointData()->GetScalars());
      for (vtkIdType i = 0; i < whole->GetNumberOfPoints(); ++i)
      {
        EXPECT_EQ(Scalar(whole, i), Scalar(expected, i));
      }
    });
}

TEST(TestInputPiece, AGridThatOneRankHasIsOnAll)
{
  openvdb::initialize();
  Gather(
    3,
    [](int rank)
    {
      const auto image = MakeSlices(0, 5);
      const auto grid = openvdb::FloatGrid::create(3.f);
      grid->tree().setValue(openvdb::Coord(1, 2, 3), 0.1f);
      Attach(image->GetInformation(), openvdb::FloatGrid::ConstPtr(grid));
      return rank == 1 ? MakeImagePiece(image, nullptr) : InputPiece();
    },
    [](vtkDataSet* whole)
    {
      const auto grid = GetAttachedGrid(whole->GetInformation());
      ASSERT_TRUE(grid);
      EXPECT_EQ(grid->tree().getValue(openvdb::Coord(1, 2, 3)), 0.1f);
      EXPECT_EQ(grid->background(), 3.f);
      EXPECT_EQ(whole->GetNumberOfPoints(), MakeSlices(0, 5)->GetNumberOfPoints());
    });
}

TEST(TestInputPiece, AnImageWithAGapIsRefused)
{
  const auto make = [](int rank)
  {
    const auto image = MakeSlices(3 * rank, 3 * rank + 1);
    return MakeImagePiece(image, image->GetPointData()->GetScalars());
  };
  EXPECT_THROW(Gather(2, make, [](vtkDataSet*) {}), std::invalid_argument);
}

TEST(TestInputPiece, AnImageWithoutTheArrayOnOneRankIsRefused)
{
  const auto make = [](int rank)
  {
    const auto image = MakeSlices(2 * rank, 2 * rank + 2);
    image->GetPointData()->GetScalars()->SetName(rank == 0 ? "one" : "another");
    return MakeImagePiece(image, image->GetPointData()->GetScalars());
  };
  try
  {
    Gather(2, make, [](vtkDataSet*) {});
    FAIL() << "accepted";
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_NE(std::string(error.what()).find("the array \"one\""), std::string::npos)
      << error.what();
  }
}

TEST(TestInputPiece, SlicesOfTwoLatticesAreRefused)
{
  const auto make = [](int rank)
  {
    const auto image = MakeSlices(2 * rank, 2 * rank + 2);
    image->SetOrigin(0.1 * rank, 0.0, 0.0);
    return MakeImagePiece(image, image->GetPointData()->GetScalars());
  };
  EXPECT_THROW(Gather(2, make, [](vtkDataSet*) {}), std::invalid_argument);
}

}

// Colours of the particles on the skin: averaged, then rounded to integers.

#include "Support/GrainTools.h"
#include "Support/PipelineTools.h"

#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace activesurface;

namespace TestPassedColors
{

namespace
{

// A red and a green particle.
const std::vector<Grain> Two = { { -0.1, 0.0, 0.0, 1, 0.0 }, { 0.1, 0.0, 0.0, 2, 1.0 } };

vtkSmartPointer<vtkDataSet> MakeColored(double)
{
  const auto cloud = MakeCloud(Two);
  const unsigned char colors[2][4] = { { 255, 0, 10, 0 }, { 0, 255, 13, 255 } };
  for (const int components : { 1, 3, 4 })
  {
    vtkNew<vtkUnsignedCharArray> array;
    array->SetName(components == 1 ? "label" : components == 3 ? "rgb" : "rgba");
    array->SetNumberOfComponents(components);
    array->InsertNextTypedTuple(colors[0]);
    array->InsertNextTypedTuple(colors[1]);
    cloud->GetPointData()->AddArray(array);
  }
  return cloud;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeColoredSkin()
{
  auto filter = MakeSkinOver(MakeSource(MakeColored));
  filter->PassTargetArraysOn();
  return filter;
}

vtkUnsignedCharArray* GetBytes(vtkActiveImplicitSurface* filter, const char* name)
{
  return vtkUnsignedCharArray::SafeDownCast(
    filter->GetOutput()->GetPointData()->GetAbstractArray(name));
}

}

// The temperature is the weight of the second particle, in double precision.
TEST(TestPassedColors, ColorsAreTheRoundedAverages)
{
  auto filter = MakeColoredSkin();
  filter->Update();
  vtkDataArray* shares = filter->GetOutput()->GetPointData()->GetArray("temperature");
  vtkUnsignedCharArray* rgba = GetBytes(filter, "rgba");
  vtkUnsignedCharArray* rgb = GetBytes(filter, "rgb");
  EXPECT_TRUE(rgba && rgb) << "arrays of bytes";
  EXPECT_EQ(rgba->GetNumberOfComponents(), 4) << "components";
  int wrong = 0, between = 0;
  for (vtkIdType v = 0; v < shares->GetNumberOfTuples(); ++v)
  {
    const double share = shares->GetComponent(v, 0);
    const double expected[4] = { 255.0 * (1.0 - share), 255.0 * share, 10.0 + 3.0 * share,
      255.0 * share };
    for (int c = 0; c < 4; ++c)
    {
      const double nearest = std::floor(expected[c] + 0.5);
      wrong += rgba->GetTypedComponent(v, c) != nearest ? 1 : 0;
      wrong += c < 3 && rgb->GetTypedComponent(v, c) != nearest ? 1 : 0;
    }
    between += share > 0.1 && share < 0.9 ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0) << "components that are not the nearest whole number";
  EXPECT_LT(50, between) << "points between the two";
}

// At x = 0 both particles have the same weight, so red, green and alpha are 127.5, and blue is
// 11.5. Halves are rounded up.
TEST(TestPassedColors, TheMiddleIsTheAverage)
{
  auto filter = MakeColoredSkin();
  filter->Update();
  int middle = 0;
  for (vtkIdType v = 0; v < filter->GetOutput()->GetNumberOfPoints(); ++v)
  {
    if (filter->GetOutput()->GetPoint(v)[0] == 0.0)
    {
      ++middle;
      const int expected[4] = { 128, 128, 12, 128 };
      for (int c = 0; c < 4; ++c)
      {
        EXPECT_EQ(int(GetBytes(filter, "rgba")->GetTypedComponent(v, c)), expected[c])
          << "component";
      }
    }
  }
  EXPECT_LT(3, middle) << "points in the middle";
}

TEST(TestPassedColors, LabelsStayThoseOfTheNearest)
{
  auto filter = MakeColoredSkin();
  filter->Update();
  int wrong = 0;
  for (vtkIdType v = 0; v < filter->GetOutput()->GetNumberOfPoints(); ++v)
  {
    const double x = filter->GetOutput()->GetPoint(v)[0];
    const int label = GetBytes(filter, "label")->GetValue(v);
    wrong += label != (x < 0.0 ? 255 : 0) && x != 0.0 ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0) << "points with another label";
}

TEST(TestPassedColors, ColorsAreTheSameForAnyNumberOfThreads)
{
  auto one = MakeColoredSkin();
  one->SetNumberOfThreads(1);
  one->Update();
  auto many = MakeColoredSkin();
  many->SetNumberOfThreads(7);
  many->Update();
  EXPECT_TRUE(GetArrayBytes(one) == GetArrayBytes(many)) << "the same bytes";
}

}

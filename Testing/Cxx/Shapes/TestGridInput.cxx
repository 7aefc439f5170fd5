// Inputs that vtkGridPotential accepts as images, inputs that it refuses, and changes that it
// detects.

#include "Support/GridShapes.h"
#include "Support/MessageCapture.h"

#include "vtkFloatArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

using namespace activesurface;

namespace TestGridInput
{

namespace
{
void ExpectError(vtkGridPotential* potential, const std::string& words)
{
  const MessageCapture messages(potential);
  EXPECT_EQ(ValueAt(potential, { 1.5, 1.5, 1.5 }), 1.0) << words << ": outside everywhere";
  EXPECT_TRUE((GradientAt(potential, { 1.5, 1.5, 1.5 }) == Point{ 0.0, 0.0, 0.0 }))
    << "no gradient";
  EXPECT_EQ(messages.Errors.size(), 1u) << words << ": one error";
  EXPECT_TRUE(messages.Has(words)) << words << ": is what it says";
  const std::string told = potential->GetError();
  EXPECT_TRUE(told.find(words) != std::string::npos && told.back() == '.') << told << ": GetError";
  double bounds[6];
  EXPECT_TRUE(!potential->GetGridBounds(bounds) && bounds[0] > bounds[1]) << words << ": no bounds";
}

}

TEST(TestGridInput, InputOfNoUseIsOneError)
{
  const auto expect = [](vtkDataSet* input, const std::string& words, const char* name = "")
  {
    vtkNew<vtkGridPotential> potential;
    potential->SetInput(input);
    potential->SetScalarArrayName(name);
    ExpectError(potential, words);
  };
  expect(vtkNew<vtkUnstructuredGrid>(), "A vtkUnstructuredGrid");
  expect(vtkNew<vtkImageData>(), "is empty");
  expect(MakeSmallImage(4, 1, 4), "is flat");
  expect(MakeSmallImage(4, 4, 4, 3), "has 3 components");
  expect(MakeSmallImage(4, 4, 4), "\"absent\" is missing", "absent");
  auto image = MakeSmallImage(4, 4, 4);
  image->GetPointData()->GetScalars()->Resize(10);
  expect(image, "has 10 values for 64 pixels");
  image = MakeSmallImage(4, 4, 4);
  image->GetPointData()->Initialize();
  expect(image, "no numeric point array");
  const auto expectNoPlace = [&expect](const std::function<void(vtkImageData*)>& spoil)
  {
    auto spoilt = MakeSmallImage(4, 4, 4);
    spoil(spoilt);
    expect(spoilt, "no position in space");
  };
  expectNoPlace([](vtkImageData* i) { i->SetSpacing(1.0, 0.0, 1.0); });
  expectNoPlace([](vtkImageData* i) { i->SetSpacing(1.0, 1.0, NaN); });
  expectNoPlace([](vtkImageData* i) { i->SetOrigin(NaN, 0.0, 0.0); });
  expectNoPlace([](vtkImageData* i) { i->SetDirectionMatrix(1, 1, 0, 0, 1, 0, 0, 0, 1); });
}

TEST(TestGridInput, WithoutActiveScalarsTheFirstArrayOfOneComponentCounts)
{
  auto image = MakeSmallImage(4, 4, 4, 3);
  image->GetPointData()->GetScalars()->SetName("vectors");
  image->GetPointData()->SetActiveScalars(nullptr);
  for (const double value : { -2.0, 3.0 })
  {
    vtkNew<vtkFloatArray> numbers;
    numbers->SetName(value < 0.0 ? "first" : "second");
    numbers->SetNumberOfTuples(64);
    numbers->Fill(value);
    image->GetPointData()->AddArray(numbers);
  }
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(image);
  EXPECT_EQ(ValueAt(potential, { 1.0, 1.0, 1.0 }), -2.0) << potential->GetError();
}

TEST(TestGridInput, ErrorsCanBeKeptQuiet)
{
  vtkNew<vtkGridPotential> potential;
  const MessageCapture messages(potential);
  EXPECT_EQ(ValueAt(potential, { 0.0, 0.0, 0.0 }), 1.0) << "no input";
  EXPECT_EQ(
    std::string(potential->GetError()), "There is no input; connect an image or a closed mesh.")
    << "GetError";
  potential->SetReportErrors(false);
  potential->SetInput(MakeSmallImage(4, 4, 1));
  EXPECT_EQ(ValueAt(potential, { 0.0, 0.0, 0.0 }), 1.0) << "flat";
  EXPECT_TRUE(std::string(potential->GetError()).find("flat") != std::string::npos) << "GetError";
  EXPECT_EQ(messages.Errors.size(), 0u) << "errors";
  potential->SetInput(MakeSmallImage(4, 4, 4));
  EXPECT_EQ(ValueAt(potential, { 1.0, 1.0, 1.0 }), -1.0) << "an image of use";
  EXPECT_EQ(std::string(potential->GetError()), "") << "GetError";
}

TEST(TestGridInput, ChangesOfTheImageAreSeen)
{
  auto image = MakeSmallImage(4, 4, 4);
  vtkNew<vtkFloatArray> other;
  other->SetName("other");
  other->SetNumberOfTuples(64);
  other->Fill(3.0);
  image->GetPointData()->AddArray(other);
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(image);
  const auto isSeen = [&](double expected, const char* sentence)
  {
    static vtkMTimeType before = 0;
    EXPECT_TRUE(potential->GetMTime() > before) << "GetMTime: " << sentence;
    EXPECT_EQ(ValueAt(potential, { 2.5, 1.0, 1.0 }), expected) << sentence;
    before = potential->GetMTime();
  };
  isSeen(-1.0, "at the start");
  image->GetPointData()->GetScalars()->Fill(-2.0);
  image->GetPointData()->GetScalars()->Modified();
  isSeen(-2.0, "pixels");
  image->SetSpacing(0.5, 1.0, 1.0);
  isSeen(1.0, "spacing: now outside");
  image->SetOrigin(2.0, 0.0, 0.0);
  isSeen(-2.0, "origin");
  potential->SetScalarArrayName("other");
  isSeen(3.0, "ScalarArrayName");
  potential->SetIsoValue(1.0);
  isSeen(2.0, "IsoValue");
  potential->InvertInsideOn();
  isSeen(-2.0, "InvertInside");
  potential->SetInput(nullptr);
  isSeen(1.0, "no input");
}

}

// Only the filter reports defects of an input; its internal objects stay silent.

#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"
#include "Support/ShapeSource.h"

#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

using namespace activesurface;

namespace TestQuietShapes
{

namespace
{

// Captures text that would otherwise go to the console.
class Console : public vtkOutputWindow
{
public:
  static Console* New();
  vtkTypeMacro(Console, vtkOutputWindow);
  void DisplayText(const char* text) override { this->Text += text; }

  std::string Text;
};
vtkStandardNewMacro(Console);

void CheckToldByTheFilter(vtkDataObject* input, const std::string& words)
{
  vtkNew<Console> console;
  vtkOutputWindow::SetInstance(console);
  auto filter = MakeSkinOver(input);
  const MessageCapture messages(filter);
  filter->UpdateTimeStep(0.0);
  vtkOutputWindow::SetInstance(nullptr);
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, words), 1) << words;
  EXPECT_EQ(console->Text, "") << words;
}

}

TEST(TestQuietShapes, DefectsOfAMeshAreToldByTheFilter)
{
  vtkNew<vtkSphereSource> bowl;
  bowl->SetEndPhi(90.0);
  bowl->Update();
  CheckToldByTheFilter(bowl->GetOutput(), "open edges");
}

TEST(TestQuietShapes, PointsOfLinesThatAreLeftOutAreToldByTheFilter)
{
  auto lines = MakeLines();
  const double missing = std::numeric_limits<double>::quiet_NaN();
  lines->GetPoints()->InsertNextPoint(missing, 0.0, 0.0);
  CheckToldByTheFilter(lines, "1 point or segment is left out");
}

}

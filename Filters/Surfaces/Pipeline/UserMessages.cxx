#include "Pipeline/UserMessages.h"

#include "vtkAlgorithm.h"
#include "vtkExecutive.h"
#include "vtkOutputWindow.h"

namespace activesurface
{

// ParaView gives each filter an executive of a class of ParaView.
bool UserMessages::IsInParaView() const
{
  return this->Filter->GetExecutive()->IsA("vtkPVCompositeDataPipeline");
}

void UserMessages::Warn(Warnings::Kind kind, const std::string& sentence)
{
  const bool isInParaView = this->IsInParaView();
  if (isInParaView && !this->Shown.insert(sentence).second)
  {
    return;
  }
  if (isInParaView && kind == Warnings::Kind::Note)
  {
    vtkOutputWindowDisplayText((sentence + "\n").c_str());
    return;
  }
  vtkWarningWithObjectMacro(this->Filter, << sentence);
}

int UserMessages::Fail(const std::string& sentence)
{
  if (!this->IsInParaView())
  {
    vtkErrorWithObjectMacro(this->Filter, << sentence);
    return 0;
  }
  const vtkMTimeType time = this->Filter->GetMTime();
  if (sentence != this->LastError || time != this->LastErrorMTime)
  {
    vtkErrorWithObjectMacro(this->Filter, << sentence);
  }
  this->LastError = sentence;
  this->LastErrorMTime = time;
  return 1;
}

}

#include "Pipeline/PushedFrames.h"

#include "Pipeline/SurfaceInput.h"
#include "Pipeline/SurfaceProperties.h"

#include "vtkAlgorithm.h"
#include "vtkCompositeDataIterator.h"
#include "vtkDataObject.h"
#include "vtkDataObjectTree.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkPointData.h"
#include "vtkTrivialProducer.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

void Check(const SurfaceProperties& properties, vtkDataObject* data, double dt)
{
  if (!std::isfinite(dt) || dt <= 0.0)
  {
    std::ostringstream text;
    text << "dt has to be a finite number > 0, the time since the last frame; it is " << dt << ".";
    throw std::invalid_argument(text.str());
  }
  if (!data)
  {
    throw std::invalid_argument("There is no frame to advance to; if a frame has no particles, "
                                "pass a vtkPolyData without points.");
  }
  if (!SurfaceInput::Accepts(SurfaceInput::Target, data))
  {
    throw std::invalid_argument(std::string("A ") + data->GetClassName() +
      " cannot be a frame; pass particles, a skeleton of lines, a closed mesh or an image.");
  }
  if (properties.Settings.IsEquilibrium())
  {
    throw std::invalid_argument("EvolutionMode EQUILIBRIUM has no time to advance in; set "
                                "EvolutionMode to TRANSIENT, or connect the data as an input.");
  }
}

// Copies the arrays of an image: a target keeps these arrays (ImageShape.cxx), but the caller may
// overwrite them for the next frame. Shares other arrays, which a target copies.
vtkSmartPointer<vtkDataObject> MakeFrame(vtkDataObject* data)
{
  auto frame = vtkSmartPointer<vtkDataObject>::Take(data->NewInstance());
  frame->ShallowCopy(data);
  if (auto image = vtkImageData::SafeDownCast(frame))
  {
    image->GetPointData()->DeepCopy(vtkImageData::SafeDownCast(data)->GetPointData());
  }
  if (auto tree = vtkDataObjectTree::SafeDownCast(frame))
  {
    tree->CopyStructure(vtkDataObjectTree::SafeDownCast(data));
    const auto block = vtkSmartPointer<vtkCompositeDataIterator>::Take(
      vtkDataObjectTree::SafeDownCast(data)->NewIterator());
    for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
    {
      tree->SetDataSet(block, MakeFrame(block->GetCurrentDataObject()));
    }
  }
  return frame;
}

}

PushedFrames::PushedFrames(vtkAlgorithm* filter)
  : Filter(filter)
{
}

// Breaks the reference cycles of the producer, its executive and its port's information: VTK's
// garbage collector does not find these cycles when it deletes the filter.
PushedFrames::~PushedFrames()
{
  this->Producer->SetOutput(nullptr);
  vtkExecutive::PRODUCER()->Remove(this->Producer->GetExecutive()->GetOutputInformation(0));
  this->Producer->SetExecutive(nullptr);
}

bool PushedFrames::AreConnected() const
{
  return this->Filter->GetNumberOfInputConnections(SurfaceInput::Target) == 1 &&
    this->Filter->GetInputAlgorithm(SurfaceInput::Target, 0) == this->Producer;
}

const std::vector<double>& PushedFrames::GetTimes()
{
  if (!this->AreConnected())
  {
    this->Stop();
  }
  return this->Times;
}

double PushedFrames::FindNextTime(const SurfaceProperties& properties, double dt)
{
  if (this->GetTimes().empty())
  {
    return properties.Clock.StartTime;
  }
  const double last = this->Times.back(), next = last + dt;
  if (!std::isfinite(next) || next <= last)
  {
    std::ostringstream text;
    text << "dt is " << dt << "; added to the time " << last
         << " of the last frame, it gives no later finite time. Change dt.";
    throw std::invalid_argument(text.str());
  }
  return next;
}

void PushedFrames::Push(const SurfaceProperties& properties, vtkDataObject* data, double dt,
  const std::vector<double>& resumed)
{
  Check(properties, data, dt);
  if (!this->HasArrived)
  {
    this->Stop();
  }
  if (resumed.empty())
  {
    this->Times.push_back(this->FindNextTime(properties, dt));
  }
  else
  {
    this->Times = resumed;
  }
  this->Before = this->Newest;
  this->Newest = MakeFrame(data);
  this->Show(this->Newest);
  if (!this->AreConnected())
  {
    this->Filter->SetInputConnection(SurfaceInput::Target, this->Producer->GetOutputPort());
  }
}

void PushedFrames::Withdraw()
{
  this->Times.pop_back();
  this->Newest = this->Before;
  this->Before = nullptr;
  this->Show(this->Newest);
}

void PushedFrames::Show(vtkDataObject* frame)
{
  this->Producer->SetOutput(frame);
  this->Producer->Modified();
}

}

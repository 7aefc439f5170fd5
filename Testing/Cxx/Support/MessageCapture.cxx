#include "Support/MessageCapture.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkNew.h"

#include <algorithm>
#include <cstdio>

namespace activesurface
{

namespace
{

bool Contains(const std::string& message, const std::string& words)
{
  return message.find(words) != std::string::npos;
}

}

MessageCapture::MessageCapture(vtkObject* object)
{
  this->Observe(object, vtkCommand::ErrorEvent, this->Errors);
  this->Observe(object, vtkCommand::WarningEvent, this->Warnings);
  if (vtkAlgorithm* algorithm = vtkAlgorithm::SafeDownCast(object))
  {
    this->Observe(algorithm->GetExecutive(), vtkCommand::ErrorEvent, this->PipelineErrors);
  }
}

MessageCapture::~MessageCapture()
{
  for (const auto& [object, tag] : this->Observers)
  {
    if (object)
    {
      object->RemoveObserver(tag);
    }
  }
}

void MessageCapture::Observe(
  vtkObject* object, unsigned long event, std::vector<std::string>& messages)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&messages);
  command->SetCallback([](vtkObject*, unsigned long, void* to, void* text)
    { static_cast<std::vector<std::string>*>(to)->emplace_back(static_cast<const char*>(text)); });
  this->Observers.emplace_back(object, object->AddObserver(event, command));
}

std::size_t MessageCapture::CountAll() const
{
  return this->Errors.size() + this->Warnings.size() + this->PipelineErrors.size();
}

bool MessageCapture::Has(const std::string& words) const
{
  const auto contains = [&words](const std::string& message) { return Contains(message, words); };
  return std::any_of(this->Errors.begin(), this->Errors.end(), contains) ||
    std::any_of(this->Warnings.begin(), this->Warnings.end(), contains);
}

std::string MessageCapture::GetLastError() const
{
  return this->Errors.empty() ? "" : this->Errors.back();
}

int MessageCapture::Count(const std::vector<std::string>& messages, const std::string& words)
{
  const auto count = std::count_if(messages.begin(), messages.end(),
    [&words](const std::string& message) { return Contains(message, words); });
  if (count != 1)
  {
    for (const std::string& message : messages)
    {
      std::printf("  captured: %s\n", message.c_str());
    }
  }
  return static_cast<int>(count);
}

}

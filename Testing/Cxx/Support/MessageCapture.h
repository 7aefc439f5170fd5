/**
 * Captures the messages of a VTK object: a test can check them, and they do not reach the console.
 */
#ifndef MessageCapture_h
#define MessageCapture_h

#include "vtkObject.h"
#include "vtkWeakPointer.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace activesurface
{

/** Captures messages during its lifetime. */
class MessageCapture
{
public:
  explicit MessageCapture(vtkObject* object);
  ~MessageCapture();
  MessageCapture(const MessageCapture&) = delete;
  void operator=(const MessageCapture&) = delete;

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
  /** Errors of the executive, if the object is an algorithm: failed requests. */
  std::vector<std::string> PipelineErrors;

  std::size_t CountAll() const;

  /** Returns true if an error or a warning of the object contains the words. */
  bool Has(const std::string& words) const;

  /** Last error of the object, or an empty string. */
  std::string GetLastError() const;

  /** Number of messages that contain the words. Prints all messages unless the number is 1. */
  static int Count(const std::vector<std::string>& messages, const std::string& words);

private:
  void Observe(vtkObject* object, unsigned long event, std::vector<std::string>& messages);

  std::vector<std::pair<vtkWeakPointer<vtkObject>, unsigned long>> Observers;
};

}

#endif

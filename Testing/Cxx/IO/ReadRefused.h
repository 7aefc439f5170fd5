// An unreadable file gives one error message and an ErrorCode.
#ifndef ReadRefused_h
#define ReadRefused_h

#include "Support/MessageCapture.h"

#include "vtkActiveEXRReader.h"

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

#include <string>

inline void CheckReadRefused(
  vtkActiveEXRReader* reader, unsigned long code, const std::string& words, const std::string& what)
{
  activesurface::MessageCapture messages(reader);
  reader->Modified();
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), code) << "ErrorCode of " << what;
  EXPECT_EQ(messages.Errors.size(), 1u) << "errors of " << what;
  const std::string sentence = messages.Errors.empty() ? "" : messages.Errors[0];
  EXPECT_TRUE(sentence.find(words) != std::string::npos) << what << ": " << sentence;
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), vtkIdType(0)) << "points after " << what;
  EXPECT_EQ(reader->GetOutput()->GetPointData()->GetNumberOfArrays(), 0) << "arrays after " << what;
}

#endif

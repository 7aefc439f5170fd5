#include "EXR/EXRAttributes.h"

#include "Common/FileError.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTypeTraits.h"

#include <ImfBoxAttribute.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfCompressionAttribute.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfRationalAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfStringVectorAttribute.h>
#include <ImfTimeCodeAttribute.h>
#include <ImfVecAttribute.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <type_traits>
#include <vector>

namespace activesurface
{

namespace
{

// OpenEXR multiplies row vectors by matrices, VTK multiplies matrices by column vectors.
template <int size, class Matrix>
std::vector<double> Transpose(const Matrix& matrix)
{
  std::vector<double> numbers(size * size);
  for (int row = 0; row < size; ++row)
  {
    for (int column = 0; column < size; ++column)
    {
      numbers[row * size + column] = matrix[column][row];
    }
  }
  return numbers;
}

// Overloads convert the value of an attribute to the numbers, or the texts, of an array.
template <class Number>
std::enable_if_t<std::is_arithmetic<Number>::value, std::vector<Number>> ToArray(Number value)
{
  return { value };
}

template <class Number>
std::vector<Number> ToArray(const std::vector<Number>& values)
{
  return values;
}

template <class Number>
std::vector<Number> ToArray(const Imath::Vec2<Number>& v)
{
  return { v.x, v.y };
}

std::vector<float> ToArray(const Imath::V3f& v)
{
  return { v.x, v.y, v.z };
}

std::vector<int> ToArray(const Imath::Box2i& box)
{
  return { box.min.x, box.min.y, box.max.x, box.max.y };
}

std::vector<double> ToArray(const Imf::Rational& ratio)
{
  return { double(ratio.n), double(ratio.d) };
}

std::vector<float> ToArray(const Imf::Chromaticities& c)
{
  return { c.red.x, c.red.y, c.green.x, c.green.y, c.blue.x, c.blue.y, c.white.x, c.white.y };
}

std::vector<double> ToArray(const Imath::M33f& matrix)
{
  return Transpose<3>(matrix);
}

std::vector<double> ToArray(const Imath::M44f& matrix)
{
  return Transpose<4>(matrix);
}

std::vector<std::string> ToArray(const std::string& text)
{
  return { text };
}

std::vector<std::string> ToArray(const Imf::TimeCode& code)
{
  char text[64];
  std::snprintf(text, sizeof(text), "%02d:%02d:%02d:%02d", code.hours(), code.minutes(),
    code.seconds(), code.frame());
  return { text };
}

std::vector<std::string> ToArray(const Imf::Compression& compression)
{
  static const char* const names[] = { "none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a",
    "dwaa", "dwab" };
  const auto number = static_cast<std::size_t>(compression);
  return { number < std::size(names) ? names[number] : std::to_string(number) };
}

void Add(const char* name, const std::vector<std::string>& texts, vtkFieldData* data)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& text : texts)
  {
    array->InsertNextValue(text);
  }
  data->AddArray(array);
}

template <class Number>
void Add(const char* name, const std::vector<Number>& numbers, vtkFieldData* data)
{
  const auto array =
    vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(vtkTypeTraits<Number>::VTKTypeID()));
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(numbers.size()));
  array->SetNumberOfTuples(numbers.empty() ? 0 : 1);
  std::copy(numbers.begin(), numbers.end(), static_cast<Number*>(array->GetVoidPointer(0)));
  data->AddArray(array);
}

// Copies an attribute of type Value. Returns false for an attribute of another type.
template <class Value>
bool Copy(const char* name, const Imf::Attribute& attribute, vtkFieldData* data)
{
  const auto* typed = dynamic_cast<const Imf::TypedAttribute<Value>*>(&attribute);
  if (typed)
  {
    Add(name, ToArray(typed->value()), data);
  }
  return typed != nullptr;
}

template <class... Values>
void CopyAny(const char* name, const Imf::Attribute& attribute, vtkFieldData* data)
{
  static_cast<void>((Copy<Values>(name, attribute, data) || ...));
}

}

void CopyEXRAttributes(const Imf::Header& header, vtkFieldData* data)
{
  for (auto entry = header.begin(); entry != header.end(); ++entry)
  {
    CopyAny<int, float, double, Imf::FloatVector, Imf::Rational, Imf::Chromaticities, Imath::Box2i,
      Imath::V2i, Imath::V2f, Imath::V3f, Imath::M33f, Imath::M44f, std::string, Imf::StringVector,
      Imf::TimeCode, Imf::Compression>(entry.name(), entry.attribute(), data);
  }
}

void AddTimeCode(Imf::Header& header, const std::string& text)
{
  int hours = 0, minutes = 0, seconds = 0, frame = 0, end = 0;
  const int read =
    std::sscanf(text.c_str(), "%2d:%2d:%2d:%2d%n", &hours, &minutes, &seconds, &frame, &end);
  const auto within = [](int value, int limit) { return value >= 0 && value <= limit; };
  if (read != 4 || static_cast<std::size_t>(end) != text.size() || !within(hours, 23) ||
    !within(minutes, 59) || !within(seconds, 59) || !within(frame, 29))
  {
    throw FileError(vtkErrorCode::UserError,
      "TimeCode \"" + text +
        "\" has to be hours:minutes:seconds:frame, as in 01:00:00:12, up to 23:59:59:29");
  }
  Imf::addTimeCode(header, Imf::TimeCode(hours, minutes, seconds, frame));
}

}

#include "EXR/EXRAttributes.h"

#include "FileError.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <ImfBoxAttribute.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfCompressionAttribute.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFramesPerSecond.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfRationalAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfStringVectorAttribute.h>
#include <ImfTimeCodeAttribute.h>
#include <ImfVecAttribute.h>

#include <array>
#include <cstdio>
#include <vector>

namespace activesurface
{

namespace
{

template <class Array, class Numbers>
void AddNumbers(const char* name, const Numbers& numbers, vtkFieldData* data)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(std::size(numbers)));
  array->SetNumberOfTuples(1);
  vtkIdType i = 0;
  for (const auto number : numbers)
  {
    array->SetValue(i++, number);
  }
  data->AddArray(array);
}

void AddTexts(const char* name, const std::vector<std::string>& texts, vtkFieldData* data)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& text : texts)
  {
    array->InsertNextValue(text);
  }
  data->AddArray(array);
}

// OpenEXR multiplies row vectors by matrices, VTK multiplies matrices by column vectors.
template <int size, class Matrix>
std::array<double, size * size> Transpose(const Matrix& matrix)
{
  std::array<double, size * size> numbers{};
  for (int row = 0; row < size; ++row)
  {
    for (int column = 0; column < size; ++column)
    {
      numbers[row * size + column] = matrix[column][row];
    }
  }
  return numbers;
}

std::string Write(const Imf::TimeCode& code)
{
  char text[64];
  std::snprintf(text, sizeof(text), "%02d:%02d:%02d:%02d", code.hours(), code.minutes(),
    code.seconds(), code.frame());
  return text;
}

std::string Write(Imf::Compression compression)
{
  static const char* const names[] = { "none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a",
    "dwaa", "dwab" };
  const auto number = static_cast<std::size_t>(compression);
  return number < std::size(names) ? names[number] : std::to_string(number);
}

template <class Attribute>
const Attribute* Cast(const Imf::Attribute& attribute)
{
  return dynamic_cast<const Attribute*>(&attribute);
}

bool CopyNumbers(const char* name, const Imf::Attribute& attribute, vtkFieldData* data)
{
  using Ints = std::vector<int>;
  using Floats = std::vector<float>;
  if (const auto* asInt = Cast<Imf::IntAttribute>(attribute))
  {
    AddNumbers<vtkIntArray>(name, Ints{ asInt->value() }, data);
  }
  else if (const auto* asFloat = Cast<Imf::FloatAttribute>(attribute))
  {
    AddNumbers<vtkFloatArray>(name, Floats{ asFloat->value() }, data);
  }
  else if (const auto* asDouble = Cast<Imf::DoubleAttribute>(attribute))
  {
    AddNumbers<vtkDoubleArray>(name, std::vector<double>{ asDouble->value() }, data);
  }
  else if (const auto* asFloats = Cast<Imf::FloatVectorAttribute>(attribute))
  {
    AddNumbers<vtkFloatArray>(name, asFloats->value(), data);
  }
  else if (const auto* asRational = Cast<Imf::RationalAttribute>(attribute))
  {
    AddNumbers<vtkDoubleArray>(name,
      std::vector<double>{ double(asRational->value().n), double(asRational->value().d) }, data);
  }
  else if (const auto* asColours = Cast<Imf::ChromaticitiesAttribute>(attribute))
  {
    const Imf::Chromaticities& c = asColours->value();
    AddNumbers<vtkFloatArray>(name,
      Floats{ c.red.x, c.red.y, c.green.x, c.green.y, c.blue.x, c.blue.y, c.white.x, c.white.y },
      data);
  }
  else
  {
    return false;
  }
  return true;
}

bool CopyVectors(const char* name, const Imf::Attribute& attribute, vtkFieldData* data)
{
  using Ints = std::vector<int>;
  using Floats = std::vector<float>;
  if (const auto* asBox = Cast<Imf::Box2iAttribute>(attribute))
  {
    const Imath::Box2i& box = asBox->value();
    AddNumbers<vtkIntArray>(name, Ints{ box.min.x, box.min.y, box.max.x, box.max.y }, data);
  }
  else if (const auto* asInts = Cast<Imf::V2iAttribute>(attribute))
  {
    AddNumbers<vtkIntArray>(name, Ints{ asInts->value().x, asInts->value().y }, data);
  }
  else if (const auto* asPair = Cast<Imf::V2fAttribute>(attribute))
  {
    AddNumbers<vtkFloatArray>(name, Floats{ asPair->value().x, asPair->value().y }, data);
  }
  else if (const auto* asTriple = Cast<Imf::V3fAttribute>(attribute))
  {
    const Imath::V3f& v = asTriple->value();
    AddNumbers<vtkFloatArray>(name, Floats{ v.x, v.y, v.z }, data);
  }
  else if (const auto* asMatrix3 = Cast<Imf::M33fAttribute>(attribute))
  {
    AddNumbers<vtkDoubleArray>(name, Transpose<3>(asMatrix3->value()), data);
  }
  else if (const auto* asMatrix4 = Cast<Imf::M44fAttribute>(attribute))
  {
    AddNumbers<vtkDoubleArray>(name, Transpose<4>(asMatrix4->value()), data);
  }
  else
  {
    return false;
  }
  return true;
}

void CopyTexts(const char* name, const Imf::Attribute& attribute, vtkFieldData* data)
{
  if (const auto* asText = Cast<Imf::StringAttribute>(attribute))
  {
    AddTexts(name, { asText->value() }, data);
  }
  else if (const auto* asTexts = Cast<Imf::StringVectorAttribute>(attribute))
  {
    AddTexts(name, asTexts->value(), data);
  }
  else if (const auto* asTime = Cast<Imf::TimeCodeAttribute>(attribute))
  {
    AddTexts(name, { Write(asTime->value()) }, data);
  }
  else if (const auto* asCompression = Cast<Imf::CompressionAttribute>(attribute))
  {
    AddTexts(name, { Write(asCompression->value()) }, data);
  }
}

}

void CopyEXRAttributes(const Imf::Header& header, vtkFieldData* data)
{
  for (auto entry = header.begin(); entry != header.end(); ++entry)
  {
    if (!CopyNumbers(entry.name(), entry.attribute(), data) &&
      !CopyVectors(entry.name(), entry.attribute(), data))
    {
      CopyTexts(entry.name(), entry.attribute(), data);
    }
  }
}

void AddTimeCode(Imf::Header& header, const std::string& text)
{
  int hours = 0, minutes = 0, seconds = 0, frame = 0, end = 0;
  const int read =
    std::sscanf(text.c_str(), "%2d:%2d:%2d:%2d%n", &hours, &minutes, &seconds, &frame, &end);
  const auto within = [](int value, int limit) { return value >= 0 && value <= limit; };
  if (read != 4 || static_cast<std::size_t>(end) != text.size() || !within(hours, 23) ||
    !within(minutes, 59) || !within(seconds, 59) || !within(frame, 59))
  {
    throw FileError(vtkErrorCode::UserError,
      "TimeCode \"" + text + "\" is not hours:minutes:seconds:frame, as in 01:00:00:12");
  }
  Imf::addTimeCode(header, Imf::TimeCode(hours, minutes, seconds, frame));
}

void AddFramesPerSecond(Imf::Header& header, double rate)
{
  Imf::addFramesPerSecond(header, Imf::guessExactFps(rate));
}

}

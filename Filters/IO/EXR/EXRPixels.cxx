#include "EXR/EXRPixels.h"

#include "Common/FileError.h"

#include "vtkDataArray.h"

#include <half.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <limits>
#include <sstream>
#include <type_traits>

namespace activesurface
{

namespace
{

// Decodes sRGB (IEC 61966-2-1). The curve is mirrored below 0 and continues above 1.
double DecodeSRGB(double value)
{
  const double size = std::abs(value);
  const double linear = size <= 0.04045 ? size / 12.92 : std::pow((size + 0.055) / 1.055, 2.4);
  return std::copysign(linear, value);
}

// Converts a value to the sample's type. Returns false if the value is out of range, a fraction for
// UINT, or an integer that FLOAT cannot represent. FLOAT and HALF round fractions; HALF rounds
// integers, too.
template <class Value>
bool Convert(Value value, float& sample)
{
  sample = static_cast<float>(value);
  if constexpr (std::is_integral<Value>::value)
  {
    return static_cast<long double>(sample) == static_cast<long double>(value);
  }
  return std::isfinite(sample) || !std::isfinite(value);
}

template <class Value>
bool Convert(Value value, half& sample)
{
  float single = 0.0f;
  const bool fits = Convert(value, single);
  sample = half(single);
  return fits && (sample.isFinite() || !std::isfinite(single));
}

template <class Value>
bool Convert(Value value, std::uint32_t& sample)
{
  constexpr std::uint32_t most = std::numeric_limits<std::uint32_t>::max();
  if constexpr (std::is_integral<Value>::value)
  {
    const bool fits = value >= Value(0) && static_cast<std::uint64_t>(value) <= most;
    sample = fits ? static_cast<std::uint32_t>(value) : 0;
    return fits;
  }
  else
  {
    const bool fits = value >= Value(0) && value <= static_cast<double>(most) &&
      static_cast<double>(value) == std::floor(static_cast<double>(value));
    sample = fits ? static_cast<std::uint32_t>(value) : 0;
    return fits;
  }
}

const char* NameOf(EXRPixel type)
{
  return type == EXRPixel::UINT
    ? "UINT (whole numbers from 0 to 4294967295)"
    : (type == EXRPixel::HALF ? "HALF (from -65504 to 65504)"
                              : "FLOAT (single precision; integers only if exact)");
}

template <class Value>
[[noreturn]] void RefuseValue(const EXRSource& source, Value value)
{
  constexpr int digits = 10; // of UINT's largest value
  std::ostringstream text;
  text << std::setprecision(digits) << "Value " << +value << " of array \""
       << source.Array->GetName() << "\"" << (source.FromSRGB ? ", decoded from sRGB," : "")
       << " does not fit into the type of channel " << source.Channel << ", " << NameOf(source.Type)
       << "; choose another type by AssignPixelType, or rescale or round the array.";
  throw FileError(vtkErrorCode::UserError, text.str());
}

template <class Sample, class Value, class Change>
void Fill(const EXRSource& source, const Value* values, Sample* samples, const Change& change)
{
  const vtkIdType count = source.Array->GetNumberOfTuples();
  const vtkIdType stride = source.Array->GetNumberOfComponents();
  vtkIdType unfit = -1;
  for (vtkIdType i = 0; i < count; ++i)
  {
    if (!Convert(change(values[i * stride]), samples[i]))
    {
      unfit = i;
    }
  }
  if (unfit >= 0)
  {
    RefuseValue(source, values[unfit * stride]);
  }
}

template <class Sample, class Value>
void FillColors(const EXRSource& source, const Value* values, Sample* samples)
{
  double scale = 1.0;
  if constexpr (std::is_integral<Value>::value)
  {
    scale = source.Normalized ? static_cast<double>(std::numeric_limits<Value>::max()) : 1.0;
  }
  const bool decode = source.FromSRGB;
  const auto change = [scale, decode](Value value)
  {
    const double part = static_cast<double>(value) / scale;
    return decode ? DecodeSRGB(part) : part;
  };
  if constexpr (sizeof(Value) == 1 && std::is_unsigned<Value>::value)
  {
    std::array<double, 256> table;
    for (std::size_t i = 0; i < table.size(); ++i)
    {
      table[i] = change(static_cast<Value>(i));
    }
    Fill(source, values, samples, [&table](Value value) { return table[value]; });
  }
  else
  {
    Fill(source, values, samples, change);
  }
}

template <class Sample, class Value>
void FillFrom(const EXRSource& source, const Value* values, std::vector<char>& bytes)
{
  bytes.resize(sizeof(Sample) * static_cast<std::size_t>(source.Array->GetNumberOfTuples()));
  auto* samples = reinterpret_cast<Sample*>(bytes.data());
  if (source.Normalized || source.FromSRGB)
  {
    FillColors(source, values, samples);
  }
  else
  {
    Fill(source, values, samples, [](Value value) { return value; });
  }
}

template <class Value>
void ConvertArray(const EXRSource& source, const Value* values, std::vector<char>& bytes)
{
  switch (source.Type)
  {
    case EXRPixel::UINT:
      FillFrom<std::uint32_t>(source, values, bytes);
      break;
    case EXRPixel::HALF:
      FillFrom<half>(source, values, bytes);
      break;
    default:
      FillFrom<float>(source, values, bytes);
  }
}

bool IsInPlace(const EXRSource& source)
{
  const int type = source.Array->GetDataType();
  const bool same = (type == VTK_FLOAT && source.Type == EXRPixel::FLOAT) ||
    (type == VTK_UNSIGNED_INT && source.Type == EXRPixel::UINT);
  return same && !source.Normalized && !source.FromSRGB;
}

}

EXRSamples MakeSamples(const EXRSource& source)
{
  EXRSamples samples;
  samples.Type = source.Type;
  vtkDataArray* array = source.Array;
  void* values = array->GetVoidPointer(0);
  if (IsInPlace(source))
  {
    samples.First = static_cast<const char*>(values) + 4 * source.Component;
    samples.Stride = 4 * static_cast<std::size_t>(array->GetNumberOfComponents());
    return samples;
  }
  switch (array->GetDataType())
  {
    vtkTemplateMacro(ConvertArray(
      source, static_cast<const VTK_TT*>(values) + source.Component, samples.Converted));
    default:
      throw FileError(vtkErrorCode::UserError,
        std::string("Array \"") + array->GetName() +
          "\" has a type that no EXR channel can store; convert it to float.");
  }
  samples.First = samples.Converted.data();
  samples.Stride = source.Type == EXRPixel::HALF ? 2 : 4;
  return samples;
}

}

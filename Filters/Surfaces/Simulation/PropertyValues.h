// Copies values of the filter's properties to fields of the settings, and prints them.

#ifndef PropertyValues_h
#define PropertyValues_h

#include "Simulation/SurfaceSettings.h"

#include <algorithm>
#include <array>
#include <ostream>

namespace activesurface
{

template <class Value, class Field>
void AssignProperty(const Value& value, Field& field)
{
  field = static_cast<Field>(value);
}

inline void AssignProperty(double* values, std::array<double, 6>& field)
{
  std::copy_n(values, 6, field.begin());
}

template <class Value>
void PrintProperty(std::ostream& os, const Property& property, const Value& value)
{
  os << property.Name << ": " << value << "\n";
}

inline void PrintProperty(std::ostream& os, const Property& property, double* values)
{
  os << property.Name << ":";
  std::for_each(values, values + 6, [&os](double value) { os << " " << value; });
  os << "\n";
}

}

#endif

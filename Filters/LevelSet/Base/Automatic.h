/**
 * Value of a property that is left to the class: -1, wherever a property has one.
 */
#ifndef Automatic_h
#define Automatic_h

namespace activesurface
{

constexpr double Automatic = -1.0;

}

#endif

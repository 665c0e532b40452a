// Arduino's IDE looks for names that end in .h.
#include "shortshot.hpp"

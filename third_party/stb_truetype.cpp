// The one place where stb_truetype is compiled.  A library of its own: a program whose window toolkit brings its own
// copy does not link this one.
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb_truetype.h>

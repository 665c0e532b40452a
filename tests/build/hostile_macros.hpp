// Macros that other headers are known to define, all at once: X11's Xlib.h, Windows' windows.h, Arduino.h, Apple's
// AssertMacros.h and MacTypes.h, curses. None of them may break the library's header.
#define Status int
#define Success 0
#define None 0L
#define Always 2
#define Bool int
#define True 1
#define False 0
#define Complex 0
#define near
#define far
#define small char
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))
#define ERROR 0
#define IN
#define OUT
#define OPTIONAL
#define abs(x) ((x) > 0 ? (x) : -(x))
#define round(x) ((x) >= 0 ? (long)((x) + 0.5) : (long)((x)-0.5))
#define constrain(x, low, high) ((x) < (low) ? (low) : ((x) > (high) ? (high) : (x)))
#define radians(degrees) ((degrees)*0.017453292519943295)
#define degrees(radians) ((radians)*57.29577951308232)
#define sq(x) ((x) * (x))
#define bit(b) (1UL << (b))
#define word unsigned
#define PI 3.1415926535897932
#define DEFAULT 1
#define check(assertion)
#define verify(assertion)
#define require(assertion, label)
#define I _Complex_I

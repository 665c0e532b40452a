// Macros that other headers are known to define, all at once: X11's Xlib.h, Windows' windows.h, Arduino.h, Apple's
// AssertMacros.h and MacTypes.h, curses; and programs' own, of one letter. None of them may break the library's header.
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
#define A 1
#define B 2
#define C 3
#define D 4
#define E 5
#define F 6
#define G 7
#define H 8
#define J 9
#define K 10
#define L 11
#define M 12
#define N 13
#define O 14
#define P 15
#define Q 16
#define R 17
#define S 18
#define T 19
#define U 20
#define V 21
#define W 22
#define X 23
#define Y 24
#define Z 25

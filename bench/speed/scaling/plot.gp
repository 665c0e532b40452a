# One scaling curve: time above, extra memory below. Before this is loaded there must be what draw_svg() sets and what
# plots.cpp writes: curve, x_name, unit, the commands x_axis, cost_axis and memory_axis, and $cost and $memory, whose
# blocks are of the same series.
name = curve; width = 760; height = 800
load style

set multiplot layout 2,1 title "Time and extra memory of the stages, against ".x_name \
  margins screen 0.12, 0.97, 0.1, 0.87 spacing screen 0, 0.06
set format x "%.0s%c"  # 10k, 1M
eval x_axis

set format y "%g"
eval cost_axis
set ylabel "time, ".unit
set key at screen 0.53, 0.925 center center maxrows 2
plot for [i = 0:*] $cost index i using 1:2 with linespoints linetype i + 1 title columnheader(1)

unset key
set xlabel x_name
eval memory_axis
set ylabel "extra memory, MB"
plot for [i = 0:*] $memory index i using 1:2 with linespoints linetype i + 1 title columnheader(1)

unset multiplot
set output

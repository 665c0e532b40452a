# One scaling curve: cost above, extra memory below, all axes logarithmic. Before this is loaded there must be what
# draw_svg() sets and what plots.cpp writes: curve, x_name, unit, x_base, cost_base, memory_base, $cost and $memory.
name = curve; width = 760; height = 760
load style

set lmargin 12
set rmargin 22

set logscale x x_base
set autoscale xfixmax
set format x "%.0s%c"  # 10k, 1M
set multiplot layout 2,1

set logscale y cost_base
set format y "%g"
set ylabel unit
plot for [i = 0:*] $cost index i using 1:2 with linespoints linetype i + 1 title columnheader(1)

set xlabel x_name
set logscale y memory_base
set ylabel "extra memory, MB"
plot for [i = 0:*] $memory index i using 1:2 with linespoints linetype i + 1 title columnheader(1)

unset multiplot
set output

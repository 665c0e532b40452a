# One scaling curve as SVG: cost above, extra memory below, all axes logarithmic. Before this is loaded the output must
# be set, and what plots.cpp writes: curve, x_name, unit, x_base, cost_base, memory_base, $cost and $memory.
set terminal svg size 760,760 font "sans-serif,14" background "white" name curve
set encoding utf8

blue = "#0072b2"; orange = "#d55e00"; green = "#009e73"; purple = "#cc79a7"; black = "#000000"
set linetype 1 linecolor rgb blue linewidth 2 pointtype 7 pointsize 0.6
set linetype 2 linecolor rgb orange linewidth 2 pointtype 5 pointsize 0.6
set linetype 3 linecolor rgb green linewidth 2 pointtype 9 pointsize 0.8
set linetype 4 linecolor rgb purple linewidth 2 pointtype 11 pointsize 0.8
set linetype 5 linecolor rgb black linewidth 2 pointtype 13 pointsize 0.8
set linetype 6 linecolor rgb "#e69f00" linewidth 2 pointtype 3 pointsize 0.8

set border 3
set tics nomirror
set grid xtics ytics linecolor rgb "#d0d0d0" linewidth 1
set key outside right top Left reverse samplen 2
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

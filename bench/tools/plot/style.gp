# What all plots have in common. Before this is loaded the script sets name, width and height.
set terminal svg size width,height font "sans-serif,14" background "white" name name
set encoding utf8

blue = "#0072b2"; orange = "#d55e00"; green = "#009e73"; purple = "#cc79a7"; black = "#000000"
set linetype 1 linecolor rgb blue linewidth 2 pointtype 7 pointsize 0.6
set linetype 2 linecolor rgb orange linewidth 2 pointtype 5 pointsize 0.6
set linetype 3 linecolor rgb green linewidth 2 pointtype 9 pointsize 0.8
set linetype 4 linecolor rgb purple linewidth 2 pointtype 11 pointsize 0.8
set linetype 5 linecolor rgb black linewidth 2 pointtype 13 pointsize 0.8
set linetype 6 linecolor rgb "#e69f00" linewidth 2 pointtype 3 pointsize 0.8
set linetype 7 linecolor rgb "#56b4e9" linewidth 2 pointtype 1 pointsize 0.8
set linetype 8 linecolor rgb "#7f7f7f" linewidth 2 pointtype 2 pointsize 0.8

set border 3
set tics nomirror
set grid xtics ytics linecolor rgb "#d0d0d0" linewidth 1
set key outside right top Left reverse samplen 2

# What all plots have in common. Before this is loaded the script sets name, width and height.
set terminal svg size width,height font "sans-serif,15" background "white" name name
set encoding utf8

# Of each series the color, the dashes and the mark are its own: the latter two tell it apart in print without colors.
set linetype 1 linecolor rgb "#0072b2" linewidth 2 dashtype 1 pointtype 7 pointsize 0.7
set linetype 2 linecolor rgb "#d55e00" linewidth 2 dashtype (12,5) pointtype 4 pointsize 0.8
set linetype 3 linecolor rgb "#009e73" linewidth 2 dashtype (3,4) pointtype 9 pointsize 0.9
set linetype 4 linecolor rgb "#cc79a7" linewidth 2 dashtype (12,4,3,4) pointtype 10 pointsize 0.9
set linetype 5 linecolor rgb "#000000" linewidth 2 dashtype 1 pointtype 12 pointsize 1.0
set linetype 6 linecolor rgb "#e69f00" linewidth 2 dashtype (20,6) pointtype 2 pointsize 0.8
set linetype 7 linecolor rgb "#56b4e9" linewidth 2 dashtype (6,3) pointtype 1 pointsize 0.8
set linetype 8 linecolor rgb "#7f7f7f" linewidth 1 dashtype (2,2) pointtype 2 pointsize 0.6
set linetype 9 linecolor rgb "#c4c4c4" linewidth 1 dashtype 1 pointtype 7 pointsize 0.4  # behind all others

set border 3
set tics nomirror
set grid xtics ytics linetype 1 linecolor rgb "#d8d8d8" linewidth 1 dashtype 1
set key outside center top horizontal Left reverse samplen 3

#!/usr/bin/env bash
# Writes scenes/stars.csv: the brightest stars of the sky, and fainter ones at random.
#
#   scenes/stars.sh > scenes/stars.csv
#
# Bright stars: J2000 right ascension and declination, visual magnitude and effective temperature,
# rounded. Fainter ones, to magnitude 6: their number grows by a factor of 3.2 per magnitude, as
# counted in the sky, and is concentrated to the Milky Way as cos b + 0.15, b the galactic
# latitude; their temperatures are those of naked-eye stars by spectral class: 40 % B and A
# (7500 to 20000 K), 15 % F (6000 to 7500 K), 10 % G (5200 to 6000 K), 30 % K (3800 to 5200 K)
# and 5 % M (3000 to 3800 K).
set -euo pipefail
export LC_ALL=C

cat <<'END'
# The sky of the gallery: bright stars, and fainter ones at random. Written by stars.sh.
name,ra,dec,mag,kelvin
Sirius,101.287,-16.716,-1.46,9940
Canopus,95.988,-52.696,-0.74,7400
Alpha Centauri,219.902,-60.834,-0.27,5800
Arcturus,213.915,19.182,-0.05,4290
Vega,279.235,38.784,0.03,9600
Capella,79.172,45.998,0.08,4970
Rigel,78.634,-8.202,0.13,12100
Procyon,114.825,5.225,0.34,6530
Achernar,24.429,-57.237,0.46,15000
Betelgeuse,88.793,7.407,0.5,3600
Hadar,210.956,-60.373,0.61,25000
Altair,297.696,8.868,0.76,7550
Acrux,186.650,-63.099,0.77,24000
Aldebaran,68.980,16.509,0.86,3900
Antares,247.352,-26.432,0.96,3660
Spica,201.298,-11.161,0.97,25300
Pollux,116.329,28.026,1.14,4670
Fomalhaut,344.413,-29.622,1.16,8590
Deneb,310.358,45.280,1.25,8525
Mimosa,191.930,-59.689,1.25,27000
Regulus,152.093,11.967,1.4,12500
Adhara,104.656,-28.972,1.5,22900
Castor,113.650,31.888,1.58,10300
Gacrux,187.791,-57.113,1.63,3690
Shaula,263.402,-37.104,1.62,25000
Bellatrix,81.283,6.350,1.64,21800
Elnath,81.573,28.608,1.65,13600
Miaplacidus,138.300,-69.717,1.67,8870
Alnilam,84.053,-1.202,1.69,27000
Alnair,332.058,-46.961,1.73,13900
Alnitak,85.190,-1.943,1.74,29500
Alioth,193.507,55.960,1.77,9020
Dubhe,165.932,61.751,1.79,4660
Mirfak,51.081,49.861,1.79,6350
Wezen,107.098,-26.393,1.83,6390
Kaus Australis,276.043,-34.385,1.85,9960
Alkaid,206.885,49.313,1.85,15500
Sargas,264.330,-42.998,1.86,7270
Avior,125.628,-59.510,1.86,3500
Menkalinan,89.882,44.947,1.9,9350
Atria,252.166,-69.028,1.91,4150
Alhena,99.428,16.399,1.92,9260
Peacock,306.412,-56.735,1.94,17700
Mirzam,95.675,-17.956,1.98,25000
Alphard,141.897,-8.659,1.98,4120
Polaris,37.955,89.264,1.98,6015
Hamal,31.793,23.462,2,4480
Diphda,10.897,-17.987,2.04,4800
Mizar,200.981,54.925,2.04,9000
Nunki,283.816,-26.297,2.05,18900
Menkent,211.671,-36.370,2.06,4980
Alpheratz,2.097,29.090,2.06,13800
Mirach,17.433,35.621,2.05,3840
Saiph,86.939,-9.670,2.09,26500
Kochab,222.676,74.156,2.08,4030
Rasalhague,263.734,12.560,2.07,7880
Algol,47.042,40.956,2.12,12500
Almach,30.975,42.330,2.1,4500
Denebola,177.265,14.572,2.13,8500
Mintaka,83.002,-0.299,2.23,29500
Schedar,10.127,56.537,2.24,4530
Caph,2.295,59.150,2.28,6800
Cih,14.177,60.717,2.47,25000
Ruchbah,21.454,60.235,2.68,8000
Segin,28.599,63.670,3.37,15200
Merak,165.460,56.382,2.37,9380
Phecda,178.458,53.695,2.44,9350
Megrez,183.857,57.033,3.31,8600
Sadr,305.557,40.257,2.23,5790
Gienah,311.553,33.970,2.48,4710
Delta Cygni,296.244,45.131,2.87,9800
Albireo,292.680,27.960,3.18,4270
Delta Crucis,183.786,-58.749,2.8,22600
END

awk 'BEGIN {
    # Lehmer 1951: whole numbers below 2^31, exact in double precision.
    seed = 20000904
    pi = atan2(0, -1)
    # The galactic north pole, J2000.
    pole_ra = 192.859 * pi / 180; pole_dec = 27.128 * pi / 180
    while (n < 5000) {
        z = 2 * unit() - 1; ra = 2 * pi * unit()
        level = sqrt(1 - z * z)
        sin_b = z * sin(pole_dec) + level * cos(pole_dec) * cos(ra - pole_ra)
        accept = unit()
        if (accept > (0.15 + sqrt(1 - sin_b * sin_b)) / 1.15) continue
        mag = 6 + log(unit()) / log(3.2)
        class = unit(); part = unit()
        if (mag < 2.6) continue
        if (class < .40) kelvin = between(7500, 20000)
        else if (class < .55) kelvin = between(6000, 7500)
        else if (class < .65) kelvin = between(5200, 6000)
        else if (class < .95) kelvin = between(3800, 5200)
        else kelvin = between(3000, 3800)
        printf ",%.2f,%.2f,%.2f,%d\n", ra * 180 / pi, atan2(z, level) * 180 / pi, mag, kelvin
        n++
    }
}
function unit() { seed = (seed * 16807) % 2147483647; return seed / 2147483647 }
# Fewer hot stars than cold ones within a class.
function between(low, high) { return 10 * int(low * exp(part * log(high / low)) / 10) }'

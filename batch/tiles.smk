# A large picture in tiles, each a job of its own, joined to one file: see docs/batch.md.
#
#   snakemake -s batch/tiles.smk --configfile batch/tiles.yaml --workflow-profile batch/slurm

from pathlib import Path

SCENE, PICTURE, OPTIONS = config["scene"], config["picture"], config["options"]
WIDTH, HEIGHT = (int(length) for length in config["size"])
SIDE = int(config["tile"])
FOLDER = Path(PICTURE).with_suffix("")
TILES = [
    f"{left}_{top}_{min(SIDE, WIDTH - left)}_{min(SIDE, HEIGHT - top)}"
    for top in range(0, HEIGHT, SIDE)
    for left in range(0, WIDTH, SIDE)
]


rule picture:
    input:
        PICTURE,


rule tile:
    input:
        SCENE,
    output:
        f"{FOLDER}/tile_{{left}}_{{top}}_{{width}}_{{height}}.png",
    threads: int(config["threads"])
    params:
        command=f"ugphoton {OPTIONS} -sz {WIDTH} {HEIGHT}",
    shell:
        "{params.command} -nt {threads} -crop {wildcards.left} {wildcards.top}"
        " {wildcards.width} {wildcards.height} -fo {output:q} {input:q}"


rule join:
    input:
        expand(f"{FOLDER}/tile_{{tile}}.png", tile=TILES),
    output:
        PICTURE,
    resources:
        # At most 10 bytes a pixel: the pixels twice, and the files.
        mem_mb=500 + 10 * WIDTH * HEIGHT // 1_000_000,
    shell:
        "ugsheet --tiles -fo {output:q} {input:q}"

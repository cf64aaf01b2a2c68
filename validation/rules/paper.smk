# The paper of paper/ as a PDF, on request alone: needs pandoc, which `make setup` does not install. Its pictures are taken as they are.
rule paper:
    input:
        text="paper/paper.md",
        bibliography="paper/paper.bib",
    output:
        pdf="paper/paper.pdf",
    log:
        "logs/validation/paper.log",
    conda:
        ROOT / "envs/r37.yaml"
    script:
        "../../paper/pdf.py"

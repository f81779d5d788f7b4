"""Names of vessels, places and structures: real-looking ones in several languages, and the elements
that make up more.
"""

from __future__ import annotations

from planner_ft.data.mission.synthetic.phrases import listed

PROPER_NAMES = listed("""
    Hilda; Marit; Torunn; Sonja; Elsa; Mette; Sula; Brage; Oryx; Petra; Ingrid; Astrid; Freya; Solveig; Gerda; Wilma; Berta; Klara; Lotte; Trude
    Agnes; Dagmar; Ragna; Vesta; Juno; Pallas; Ceres; Hebe; Titan; Rhea; Dione; Ariel; Oberon; Triton; Nereid; Calypso; Atlas; Pandora; Antje; Wiebke
    Janus; Phoebe; Castor; Pollux; Trongate; Nordfjord; Vester; Skarvik; Holmsund; Tarnholm; Kestrel; Marrow Point; Gull Rock; Saltby; Rixt; Femke
    Thornwick; Graveney; Hexton; Cardew; Blythe; Ferris; Ruddock; Penhallow; Tregarth; Lanyon; Kerrow; Zennor; Pendower; Theodora; Amalia; Cecilie
    Lochinver; Stornaway; Ardmore; Corrie; Tolsta; Barvas; Varberg; Halden; Larvik; Mandal; Egersund; Haugen; Skagen; Thisted; Rosalind; Margarethe
    Esbjerg; Husum; Norden; Emden; Jade; Weser; Warnow; Ustka; Liepaja; Parnu; Haapsalu; Kotka; Old Tom; Grey Lady; Blue Heron; Red Fox; Leonora
    White Swan; Sea Lark; Sandpiper; Curlew; Dunlin; Merlin; Peregrine; Cormorant; Gannet; Puffin; Guillemot; Fulmar; Petrel; Meridian; Horizon
    Vanguard; Resolve; Endurance; Patience; Fortune; Liberty; Nimbus; Cirrus; Stratus; Polaris; Vega; Altair; Sirius; Arcturus; Rigel; Capella
    Bluebell; Thistle; Heather; Foxglove; Bramble; Juniper; Rowan; Aspen; Willow; Hawthorn; Larch; Maple; Rufus; Otto; Anton; Casimir; Leopold
    Magnus; Sigurd; Haakon; Olaf; Gustav; Knut; Sven; Björn; Åse; Øystein; Jørgen; Märta; Jürgen; Zoë; Inês; João; Renée; Chloé; Matteo; Giulia; Pilar
    Dolores; Kenji; Aiko; Mei Lin; Thornbury; Ashdown; Kingsway; Millgate; Northgate; Ropewalk; Tidewell; Deepwater; Longreach; Shingle End; Wim
    Cold Harbour; Windy Ridge; Eagle Ness; Raven Holm; Prince Albert; Queen Bee; Lord Nelson; Saint Olaf; Santa Rosa; Don Pedro; Mary Ann; Yngve
    Lady Jane; Big Bertha; Little John; Moby; Nemo; Goliath; Samson; Aurora; Stella Maris; Maria Pia; Santa Clara; San Telmo; Belle Île; Étoile
    Marianne; Hirondelle; Goéland; L'Espérance; Notre Dame; Bonaventure; Kaiser; Seeadler; Möwe; Nordlicht; Schwan; Delphin; Fortuna; Concordia
    Minerva; Neptun; Najade; Undine; Loreley; Hansa; Hammonia; Frisia; Borkum; Juist; Langeoog; Amrum; Sylt; Fehmarn; Rügen; Usedom; Hiddensee
    Zeeland; Texel; Vlieland; Ameland; De Ruyter; Van Gogh; Willemijn; Hendrika; Grietje; Noordster; Zeemeeuw; Zwaluw; Bolette; Kirsten; Fyn
    Langeland; Bornholm; Lolland; Ærø; Svendborg; Havfruen; Havørn; Ternen; Polarstjernan; Sjöfågel; Vinga; Öland; Gotland; Visby; Trelleborg
    Lofoten; Senja; Stokke; Bømlo; Sotra; Karmøy; Stavanger; Molde; Kristiansund; Hitra; Frøya; Vega Nord; Aino; Suomenlinna; Hanko; Saimaa; Tuuli
    Meri; Kaarina; Saaremaa; Hiiumaa; Tallinna; Daugava; Riga; Neringa; Gdynia; Hel; Wisła; Bałtyk; Syrenka; Zawisza; Dar; Odra; Kaszuby; Lubin
    Ilha Verde; Boa Vista; Rainha; Nazaré; Peniche; Sagres; Gaivota; Vasco; Cabo Frio; Esperanza; Virgen del Mar; Golondrina; Ría de Vigo; Galatea
    Cala Blanca; Trafalgar; Isla Mayor; Santoña; Bermeo; Donosti; Itsaso; Ligure; Portofino; Capri; Ischia; Adriatica; Gabbiano; Stromboli; Elba
    Zadar; Jadran; Galeb; Korčula; Poseidon; Thalassa; Eleni; Agios Nikolaos; Nafplio; Ithaka; Kalymnos; Bosporus; Marmara; Yıldız; Deniz; Sakura
    Hayabusa; Shinsei; Kaiyo; Nagasaki; Haneul; Jin Hai; Ocean Lily; Orchid; Banyan; Coral Bay; Tamar; Severn; Humber; Medway; Solent; Tyne; Tees
    Forth; Clyde; Tay; Moray; Orkney; Shetland; Fair Isle; Lundy; Skokholm; Bardsey; Anglesey; Menai; Mersey; Liffey; Shannon; Dingle; Valentia
    Brendan; Fionn; Niamh; Cuan; Rathlin; Skerries; Ailsa Craig; Kilda; Iona; Mull; Islay; Jura; Rona; Hebridean; Caledonia; Morwenna; Tamsin; Jago
""")
PLACE_STARTS = listed("""
    Sand; Holm; Kirk; Nor; Sund; Vest; Øst; Ravn; Ulv; Berg; Strand; Lang; Sten; Eid; Ask; Björk; Fisk; Hav; Kalv; Laks; Mar; Ny; Od; Rav; Skar
    Svart; Tor; Ulle; Vik; Elv; Alder; Ash; Brad; Cray; Dun; Elms; Fal; Garn; Hather; Ink; Kel; Lyd; Mal; Nether; Oak; Pen; Quarn; Roth; Salt; Thorn
    Up; Wen; Whit; Yar; Alten; Brun; Cux; Dorn; Elb; Fried; Glück; Heiligen; Itze; Küh; Lüne; Meld; Neu; Otter; Rends; Schön; Trave; Wester; Wilhelms
    Zand; Har; Den; Water; Zier; Kam; Brou; Goed; Katt; Lelie; Middel; Nieuw; Ooster; Oude; Scheven; Vlis; Mid; Bal; Inver; Kil; Loch; Strath; Tober
""")
PLACE_ENDS = listed("""
    vik; sund; holm; nes; fjord; havn; stad; by; ø; øya; berg; voll; dal; eid; lund; hamn; ham; ton; wick; ford; mouth; ness; haven; bridge; port; stow
    ley; worth; combe; thorpe; sey; hafen; koog; siel; burg; münde; au; beck; dorf; feld; horn; ort; werder; büttel; dam; sluis; dijk; kerk; zijl; hoek
    oord; wijk; duin; ken; more; moor; mere; pool; head; cliff; well; gate; stone; bury; field; den
""")
SHIP_STARTS = listed("""
    Nordic; Baltic; Atlantic; Celtic; Southern; Northern; Eastern; Western; Arctic; Polar; Golden; Silver; Ocean; Sea; Royal; Viking; Blue; Coastal
    Island; Harbour; Highland; Iron; Wind; Tidal; Pacific; Global; Stella; Star; Bay; River; Estuary; Delta; Solar; Swift; Brave; Noble; Bright; Fair
    Island; Grand; True; Eider; Wadden; Skager; Hanse; Norse; Fjord; North Sea; Channel; Cape
""")
SHIP_ENDS = listed("""
    Star; Spirit; Trader; Pioneer; Breeze; Eagle; Explorer; Dawn; Carrier; Queen; Prince; Princess; Venture; Fisher; Osprey; Falcon; Pearl; Wind; Wave
    Light; Runner; Ranger; Pride; Guardian; Surveyor; Constructor; Installer; Supporter; Server; Challenger; Endeavour; Express; Hunter; Lady; Lass
    Legend; Mariner; Master; Navigator; Progress; Rose; Sentinel; Swan; Titan; Tern; Voyager; Warrior; Worker; Leader; Crown; Harrier; Provider; Power
""")
